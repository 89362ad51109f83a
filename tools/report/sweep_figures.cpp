// SPDX-License-Identifier: Apache-2.0
// Times along an axis.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "html/line_plot.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {
namespace {

using Kind = html::PlotSeries::Kind;

constexpr double kLogarithmicFrom = 12.0;  // The most over the least, above which small ones would not be seen.

html::PlotSeries series_of(const Sources& sources, const std::string& layout, const std::vector<const Case*>& cases,
                           const std::vector<double>& x, const std::string& stage) {
    html::PlotSeries series{.name = layout, .points = {}, .colour = sources.colour_of(layout)};
    if (layout == kNullLayout) series.kind = Kind::floor;
    for (size_t i = 0; i < cases.size(); ++i) {
        const Times* times = cases[i] != nullptr ? cases[i]->stage(stage) : nullptr;
        if (times == nullptr) continue;
        series.points.push_back({x[i], times->median});
        if (series.kind == Kind::curve)
            series.bands.push_back({std::min(times->q1, times->median), std::max(times->q3, times->median)});
    }
    return series;
}

html::PlotSeries copy_series(const Sweep& sweep, const std::vector<double>& x) {
    html::PlotSeries series{.name = "a copy of the map of " + sweep.file->baseline, .points = {}, .kind = Kind::dots};
    const auto cases = sweep.layouts.find(sweep.file->baseline);
    if (cases == sweep.layouts.end()) return series;
    for (size_t i = 0; i < cases->second.size(); ++i)
        if (const Case* c = cases->second[i]; c != nullptr && c->copy_ms) series.points.push_back({x[i], *c->copy_ms});
    return series;
}

// Over an axis that goes by doubling, or nearly so, even steps are those of the logarithm.
bool goes_by_factors(const std::vector<double>& numbers) {
    return numbers.size() > 1 && numbers.back() / numbers.front() >= 3.0;
}

bool is_wide(const std::vector<html::PlotSeries>& series) {
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (const html::PlotSeries& s : series) {
        if (s.kind != Kind::curve) continue;
        for (const html::PlotPoint& p : s.points) {
            least = std::min(least, p.y);
            most = std::max(most, p.y);
        }
        for (const html::PlotBand& band : s.bands) least = std::min(least, band.low);
    }
    return least > 0.0 && most / least >= kLogarithmicFrom;
}

/// Of floors that are near some may be 0, which has no logarithm either. Says which are left out.
std::string drop_far_floors(std::vector<html::PlotSeries>& series) {
    const auto least = [](const html::PlotSeries& s) {
        return std::min_element(s.points.begin(), s.points.end(), [](const auto& a, const auto& b) { return a.y < b.y; })->y;
    };
    double fastest = std::numeric_limits<double>::infinity();
    for (const html::PlotSeries& s : series)
        if (s.kind == Kind::curve) fastest = std::min(fastest, least(s));
    std::string text;
    std::erase_if(series, [&](const html::PlotSeries& s) {
        const bool is_far = s.kind != Kind::curve && std::isfinite(fastest) && least(s) * kFloorWithin < fastest;
        if (is_far)
            text +=
                fmt::format(" Below the plot, a floor: {}, {} to {} ms.", s.kind == Kind::floor ? "the null layout" : s.name,
                            shown(s.points.front().y), shown(s.points.back().y));
        return is_far;
    });
    return text;
}

std::string caption_of(const Sweep& sweep, const html::LinePlot& plot, const std::string& stage) {
    const html::PlotSeries *best = nullptr, *worst = nullptr, *baseline = nullptr;
    for (const html::PlotSeries& s : plot.series) {
        if (s.kind != Kind::curve || s.points.empty()) continue;
        if (s.name == sweep.file->baseline) baseline = &s;
        if (s.points.back().x != plot.x_ticks.back()) continue;
        if (best == nullptr || s.points.back().y < best->points.back().y) best = &s;
        if (worst == nullptr || s.points.back().y > worst->points.back().y) worst = &s;
    }
    const Axis& axis = sweep.file->axes[sweep.axis];
    std::string caption;
    if (baseline != nullptr)
        caption += fmt::format("From {0} {1} to {2} the {3} of {4} goes from {5} to {6} ms. ", axis.name, axis.values.front(),
                               axis.values.back(), stage, baseline->name, shown(baseline->points.front().y),
                               shown(baseline->points.back().y));
    if (best != nullptr && worst != best)
        caption += fmt::format("At {} {} is fastest with {} ms, {} slowest with {} ms. ", axis.values.back(), best->name,
                               shown(best->points.back().y), worst->name, shown(worst->points.back().y));
    return caption + "Lines join medians, bands reach from the lower to the upper quartile" +
           (plot.logarithmic_y ? "; the scale of times is logarithmic." : ".");
}

}  // namespace

std::vector<Figure> sweep_figures(const Sources& sources, const std::string& stage) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        for (const Sweep& sweep : sweeps_of(file)) {
            const Axis& axis = file.axes[sweep.axis];
            const std::vector<double> numbers = numbers_of(axis.values);
            html::LinePlot plot{.title = sources.title(file, fmt::format("{}, {} by {}", sweep.title(), stage, axis.name)),
                                .x_title = axis.name,
                                .y_title = stage + ", ms",
                                .series = {},
                                .x_ticks = numbers,
                                .logarithmic_x = goes_by_factors(numbers),
                                .with_legend = true};
            if (numbers.empty()) {
                plot.x_names = axis.values;
                for (size_t i = 0; i < axis.values.size(); ++i) plot.x_ticks.push_back(static_cast<double>(i + 1));
            }
            for (const std::string& layout : layouts_of({file}))
                if (const auto cases = sweep.layouts.find(layout); cases != sweep.layouts.end())
                    plot.series.push_back(series_of(sources, layout, cases->second, plot.x_ticks, stage));
            if (stage == "build") plot.series.push_back(copy_series(sweep, plot.x_ticks));
            std::erase_if(plot.series, [](const html::PlotSeries& s) { return s.points.empty(); });
            if (plot.series.empty()) continue;
            plot.logarithmic_y = is_wide(plot.series);
            const std::string undrawn = plot.logarithmic_y ? drop_far_floors(plot.series) : "";
            figures.push_back({sources.name(file, stage, axis.name + " " + sweep.title()), html::line_plot(plot),
                               caption_of(sweep, plot, stage) + undrawn, sweep.is_first});
        }
    }
    return figures;
}

}  // namespace gnomon::report
