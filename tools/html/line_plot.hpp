// SPDX-License-Identifier: Apache-2.0
// Curves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "html/plot.hpp"

namespace gnomon::html {

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    double error = 0.0;  ///< Half the length of its error bar.
};

/// From where to where the values of a point lie, above and below it.
struct PlotBand {
    double low = 0.0;
    double high = 0.0;
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;                              ///< By x.
    std::vector<PlotBand> bands = {};                           ///< One for each point, or none.
    std::optional<size_t> colour = {};                          ///< Which colour and mark [its number among the series].
    enum class Kind { curve, floor, dots } kind = Kind::curve;  ///< Reference lines are dashed and without marks.
};

struct LinePlot {
    std::string title;
    std::string x_title;
    std::string y_title;
    std::vector<PlotSeries> series;
    std::vector<double> x_ticks = {};       ///< Where x is marked [round numbers from 0]. Not empty: nothing is beyond them.
    std::vector<std::string> x_names = {};  ///< What is written there [the numbers].
    bool logarithmic_x = false;             ///< Needs x_ticks.
    bool logarithmic_y = false;             ///< y, and bands, are above 0; else the axis begins at 0.
    bool with_legend = false;               ///< Below.
};

Plot line_plot(const LinePlot& plot);

/// The names of colours c0, c1, ... as HTML.
std::string legend_list(const std::vector<std::string>& names);

}  // namespace gnomon::html
