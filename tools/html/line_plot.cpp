// SPDX-License-Identifier: Apache-2.0
// Curves.
#include "html/line_plot.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "html/html.hpp"
#include "html/scale.hpp"
#include "html/svg.hpp"

namespace gnomon::html {
namespace {

constexpr double kWidth = 480.0, kHeight = 300.0, kLeft = 64.0, kRight = 16.0, kTop = 12.0, kBottom = 48.0;

struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = 0.0;

    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

Scale x_axis(const LinePlot& plot) {
    const double from = kLeft, to = kWidth - kRight;
    if (!plot.x_ticks.empty()) return Scale::with_ticks(plot.x_ticks, plot.logarithmic_x, from, to);
    Extent x;
    for (const PlotSeries& s : plot.series)
        for (const PlotPoint& p : s.points) x.add(p.x);
    return Scale::linear(x.most, from, to);
}

Scale y_axis(const LinePlot& plot) {
    const double from = kHeight - kBottom, to = kTop;
    Extent y;
    for (const PlotSeries& s : plot.series) {
        for (const PlotPoint& p : s.points) {
            y.add(p.y);
            y.add(p.y + p.error);
        }
        for (const PlotBand& band : s.bands) {
            y.add(band.low);
            y.add(band.high);
        }
    }
    return plot.logarithmic_y && y.least < y.most ? Scale::logarithmic(y.least, y.most, from, to)
                                                  : Scale::linear(y.most, from, to);
}

std::string axes(const LinePlot& plot, const Scale& x, const Scale& y) {
    std::string content;
    const double bottom = kHeight - kBottom;
    content += line("axis", kLeft, bottom, kWidth - kRight, bottom);
    for (const double tick : y.ticks()) {
        if (tick != 0.0) content += line("grid", kLeft, y.at(tick), kWidth - kRight, y.at(tick));
        content += label("tick left", kLeft - 8.0, y.at(tick) + 4.0, tick_text(tick));
    }
    double free_from = 0.0;
    for (size_t i = 0; i < x.ticks().size(); ++i) {
        const double place = x.at(x.ticks()[i]);
        const std::string text = i < plot.x_names.size() ? shortened(plot.x_names[i], 90.0) : tick_text(x.ticks()[i]);
        const double half = 0.5 * text_width(text);
        content += line("axis", place, bottom, place, bottom + 4.0);
        if (place - half < free_from) continue;
        content += label("tick below", place, bottom + 18.0, text);
        free_from = place + half + 4.0;
    }
    content += label("title below", 0.5 * (kLeft + kWidth - kRight), kHeight - 8.0, plot.x_title);
    return content + label_upward("title below", 14.0, 0.5 * (kTop + bottom), plot.y_title);
}

std::string curve(const PlotSeries& s, size_t colour, const Scale& x, const Scale& y) {
    std::string path, marks, band;
    for (const PlotPoint& p : s.points) {
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.at(p.x), y.at(p.y));
        if (p.error > 0.0) marks += line("error", x.at(p.x), y.at(p.y - p.error), x.at(p.x), y.at(p.y + p.error));
        if (s.kind == PlotSeries::Kind::curve)
            marks += marker(colour, x.at(p.x), y.at(p.y), fmt::format("{}: {:.4g} at {:g}", s.name, p.y, p.x));
    }
    if (s.kind != PlotSeries::Kind::curve) {
        const char* type = s.kind == PlotSeries::Kind::floor ? "floor" : "floor dots";
        return element("path", {{"class", type}, {"d", path}}, element("title", escaped(s.name)));
    }
    for (size_t i = 0; i < s.bands.size(); ++i)
        band += fmt::format("{}{:.1f} {:.1f}", band.empty() ? "M" : "L", x.at(s.points[i].x), y.at(s.bands[i].high));
    for (size_t i = s.bands.size(); i-- > 0;) band += fmt::format("L{:.1f} {:.1f}", x.at(s.points[i].x), y.at(s.bands[i].low));
    if (!band.empty()) band = element("path", {{"class", "band"}, {"d", band + "z"}}, "");
    return element("g", {{"class", colour_class(colour)}},
                   band + element("path", {{"class", "curve"}, {"d", path}}, "") + marks);
}

}  // namespace

Plot line_plot(const LinePlot& plot) {
    using Kind = PlotSeries::Kind;
    const Scale x = x_axis(plot), y = y_axis(plot);
    std::string content = axes(plot, x, y);
    std::vector<LegendEntry> entries;
    for (size_t i = 0; i < plot.series.size(); ++i) {
        const PlotSeries& s = plot.series[i];
        const size_t colour = s.colour.value_or(i);
        content += curve(s, colour, x, y);
        entries.push_back({s.kind == Kind::curve   ? LegendEntry::Kind::curve
                           : s.kind == Kind::floor ? LegendEntry::Kind::floor
                                                   : LegendEntry::Kind::dots,
                           colour, s.name});
    }
    double height = kHeight;
    if (plot.with_legend) {
        const Legend below = legend(entries, 16.0, kHeight + 4.0, kWidth - 32.0);
        content += below.content;
        height += below.height + 8.0;
    }
    return {"curves", plot.title, kWidth, height, content};
}

std::string legend_list(const std::vector<std::string>& names) {
    std::string items;
    for (size_t i = 0; i < names.size(); ++i)
        items += element("li", element("i", {{"class", colour_class(i)}}, "") + escaped(names[i]));
    return element("ul", {{"class", "legend"}}, items);
}

}  // namespace gnomon::html
