// SPDX-License-Identifier: Apache-2.0
// Plots as SVG. Colours are those of the page's style: classes c0, c1, ... by series.
#pragma once

#include <string>
#include <vector>

namespace gnomon::reproduce {

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    double error = 0.0;  ///< Half the length of its error bar.
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  ///< By x.
};

/// Curves over a common axis, y from 0.
std::string line_plot(const std::string& title, const std::string& x_title, const std::string& y_title,
                      const std::vector<PlotSeries>& series);

/// A bar of one or several parts.
struct Bar {
    std::string name;
    std::vector<double> parts;
    double error = 0.0;  ///< Of the whole.
    std::string value;   ///< Written behind it.
};

/// Bars from 0 to the right, one below the other. by_part: colours are those of the parts, else those of the bars.
std::string bar_plot(const std::string& title, const std::string& x_title, const std::vector<Bar>& bars, bool by_part);

/// The names of colours c0, c1, ...
std::string legend(const std::vector<std::string>& names);

/// 0 and evenly spaced round numbers after it, until one is not below `most`.
std::vector<double> ticks(double most);

}  // namespace gnomon::reproduce
