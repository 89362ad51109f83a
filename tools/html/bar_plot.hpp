// SPDX-License-Identifier: Apache-2.0
// Bars.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "html/plot.hpp"

namespace gnomon::html {

/// A bar of one or several parts.
struct Bar {
    std::string name;
    std::vector<double> parts = {};
    double error = 0.0;                ///< Of the whole.
    std::string value = {};            ///< Written behind it.
    std::optional<double> floor = {};  ///< Where a stroke across it is.
};

/// Bars from 0 to the right, one below the other.
struct BarPlot {
    std::string title;
    std::string x_title;
    std::vector<Bar> bars = {};
    bool by_part = false;                      ///< Colours are those of the parts, else those of the bars.
    std::vector<std::string> part_names = {};  ///< Not empty: with a legend below, and in what the pointer shows.
    std::vector<size_t> part_colours = {};     ///< [0, 1, 2, ...]
    std::string floor_name = {};               ///< In the legend.
    std::optional<double> line = {};           ///< Where a dashed line crosses all bars.
    std::string line_name = {};                ///< In the legend.
    double width = 640.0;
};

Plot bar_plot(const BarPlot& plot);

}  // namespace gnomon::html
