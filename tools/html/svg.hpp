// SPDX-License-Identifier: Apache-2.0
// What plots are drawn with, as text of SVG. Coordinates are pixels, to the right and downward; what is seen of a class is in
// files/plot.css.
#pragma once

#include <string>
#include <vector>

namespace gnomon::html {

/// With one decimal: a coordinate.
std::string at(double value);

/// Short: 0.25, 1e-05.
std::string tick_text(double value);

/// Colour of a series: c0 to c7, and again.
std::string colour_class(size_t series);

std::string line(const std::string& type, double x0, double y0, double x1, double y1);
std::string label(const std::string& type, double x, double y, const std::string& text);

/// A label that is drawn upward, its middle at (x, y).
std::string label_upward(const std::string& type, double x, double y, const std::string& text);

/// hint: text that is shown where the pointer is; none where empty.
std::string rectangle(const std::string& type, double x, double y, double width, double height, const std::string& hint);

/// One of several shapes, by which series of one colour are told apart; 3.5 pixels around (x, y).
std::string marker(size_t series, double x, double y, const std::string& hint);

/// About how wide a label is.
double text_width(const std::string& text);

/// A label that is not wider, shortened where it would be.
std::string shortened(const std::string& text, double width);

/// A line of a legend.
struct LegendEntry {
    enum class Kind { part, curve, point, floor, dots, zone };
    Kind kind = Kind::part;
    size_t series = 0;  ///< Of parts, curves and points.
    std::string name;
};

/// Rows of names with their marks, below (x, y), no wider than `width`.
struct Legend {
    std::string content;
    double height = 0.0;
};
Legend legend(const std::vector<LegendEntry>& entries, double x, double y, double width);

}  // namespace gnomon::html
