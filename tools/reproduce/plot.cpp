// SPDX-License-Identifier: Apache-2.0
// Plots as SVG.
#include "reproduce/plot.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "reproduce/html.hpp"

namespace gnomon::reproduce {
namespace {

constexpr double kWidth = 480.0, kHeight = 300.0, kLeft = 64.0, kRight = 16.0, kTop = 12.0, kBottom = 48.0;
constexpr double kBarHeight = 18.0, kBarStep = 28.0, kBarLeft = 190.0, kBarRight = 110.0;

std::string at(double value) { return fmt::format("{:.1f}", value); }
std::string tick_text(double value) { return fmt::format("{:g}", std::round(value * 1e9) / 1e9); }
std::string colour(size_t series) { return fmt::format("c{}", series % 8); }

std::string line(const std::string& type, double x0, double y0, double x1, double y1) {
    return element("line", {{"class", type}, {"x1", at(x0)}, {"y1", at(y0)}, {"x2", at(x1)}, {"y2", at(y1)}}, "");
}

std::string label(const std::string& type, double x, double y, const std::string& text) {
    return element("text", {{"class", type}, {"x", at(x)}, {"y", at(y)}}, escaped(text));
}

std::string plot(const std::string& type, const std::string& title, double width, double height, const std::string& content) {
    const std::string svg =
        element("svg", {{"viewBox", fmt::format("0 0 {} {}", width, height)}, {"role", "img"}, {"aria-label", title}}, content);
    return element("figure", {{"class", "plot " + type}}, element("figcaption", escaped(title)) + svg) + "\n";
}

}  // namespace

std::vector<double> ticks(double most) {
    if (!(most > 0.0)) most = 1.0;
    // 1, 2 or 5 times a power of ten, for 4 to 9 of them.
    double step = std::pow(10.0, std::floor(std::log10(most / 4.0)));
    for (const double factor : {2.0, 2.5, 2.0}) {
        if (most / step <= 8.0) break;
        step *= factor;
    }
    std::vector<double> result = {0.0};
    while (result.back() < most * (1.0 - 1e-9)) result.push_back(step * static_cast<double>(result.size()));
    return result;
}

std::string line_plot(const std::string& title, const std::string& x_title, const std::string& y_title,
                      const std::vector<PlotSeries>& series) {
    double most_x = 0.0, most_y = 0.0;
    for (const PlotSeries& s : series) {
        for (const PlotPoint& p : s.points) {
            most_x = std::max(most_x, p.x);
            most_y = std::max(most_y, p.y + p.error);
        }
    }
    const std::vector<double> x_ticks = ticks(most_x), y_ticks = ticks(most_y);
    const double bottom = kHeight - kBottom;
    const auto x_of = [&](double x) { return kLeft + (kWidth - kLeft - kRight) * x / x_ticks.back(); };
    const auto y_of = [&](double y) { return bottom - (bottom - kTop) * y / y_ticks.back(); };

    std::string content;
    for (const double tick : y_ticks) {
        content += line(tick == 0.0 ? "axis" : "grid", kLeft, y_of(tick), kWidth - kRight, y_of(tick));
        content += label("tick left", kLeft - 8.0, y_of(tick) + 4.0, tick_text(tick));
    }
    for (const double tick : x_ticks) content += label("tick below", x_of(tick), bottom + 18.0, tick_text(tick));
    content += label("title below", 0.5 * (kLeft + kWidth - kRight), kHeight - 8.0, x_title);
    content += element("text",
                       {{"class", "title below"}, {"transform", fmt::format("translate(14 {:.1f}) rotate(-90)", 0.5 * bottom)}},
                       escaped(y_title));
    for (size_t i = 0; i < series.size(); ++i) {
        std::string path, marks;
        for (const PlotPoint& p : series[i].points) {
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_of(p.x), y_of(p.y));
            if (p.error > 0.0) marks += line("error", x_of(p.x), y_of(p.y - p.error), x_of(p.x), y_of(p.y + p.error));
            marks += element("circle", {{"cx", at(x_of(p.x))}, {"cy", at(y_of(p.y))}, {"r", "3.5"}},
                             element("title", escaped(fmt::format("{}: {:.4g} at {:g}", series[i].name, p.y, p.x))));
        }
        content += element("g", {{"class", colour(i)}}, element("path", {{"d", path}}, "") + marks);
    }
    return plot("curves", title, kWidth, kHeight, content);
}

std::string bar_plot(const std::string& title, const std::string& x_title, const std::vector<Bar>& bars, bool by_part) {
    double most = 0.0;
    for (const Bar& bar : bars) {
        double sum = bar.error;
        for (const double part : bar.parts) sum += part;
        most = std::max(most, sum);
    }
    const std::vector<double> x_ticks = ticks(most);
    const double width = kWidth + 160.0, bottom = kTop + kBarStep * static_cast<double>(bars.size());
    const auto x_of = [&](double x) { return kBarLeft + (width - kBarLeft - kBarRight) * x / x_ticks.back(); };

    std::string content;
    for (const double tick : x_ticks) {
        content += line(tick == 0.0 ? "axis" : "grid", x_of(tick), kTop, x_of(tick), bottom);
        content += label("tick below", x_of(tick), bottom + 18.0, tick_text(tick));
    }
    content += label("title below", 0.5 * (kBarLeft + width - kBarRight), bottom + 38.0, x_title);
    for (size_t i = 0; i < bars.size(); ++i) {
        const double y = kTop + kBarStep * static_cast<double>(i) + 0.5 * (kBarStep - kBarHeight);
        double sum = 0.0;
        for (size_t part = 0; part < bars[i].parts.size(); ++part) {
            const double next = sum + bars[i].parts[part];
            content += element("rect",
                               {{"class", colour(by_part ? part : i)},
                                {"x", at(x_of(sum))},
                                {"y", at(y)},
                                {"width", at(x_of(next) - x_of(sum))},
                                {"height", at(kBarHeight)}},
                               element("title", escaped(fmt::format("{}: {:.4g}", bars[i].name, bars[i].parts[part]))));
            sum = next;
        }
        const double middle = y + 0.5 * kBarHeight;
        if (bars[i].error > 0.0)
            content += line("error", x_of(std::max(0.0, sum - bars[i].error)), middle, x_of(sum + bars[i].error), middle);
        content += label("name left", kBarLeft - 8.0, middle + 4.0, bars[i].name);
        content += label("value", x_of(sum + bars[i].error) + 6.0, middle + 4.0, bars[i].value);
    }
    return plot("bars", title, width, bottom + kBottom, content);
}

std::string legend(const std::vector<std::string>& names) {
    std::string items;
    for (size_t i = 0; i < names.size(); ++i)
        items += element("li", element("i", {{"class", colour(i)}}, "") + escaped(names[i]));
    return element("ul", {{"class", "legend"}}, items);
}

}  // namespace gnomon::reproduce
