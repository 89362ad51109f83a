// SPDX-License-Identifier: Apache-2.0
// Bars.
#include "html/bar_plot.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numeric>

#include "html/html.hpp"
#include "html/scale.hpp"
#include "html/svg.hpp"

namespace gnomon::html {
namespace {

constexpr double kTop = 12.0, kBottom = 48.0, kBarHeight = 18.0, kBarStep = 28.0, kGap = 8.0, kEdge = 8.0;

double sum_of(const Bar& bar) { return std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0); }

// What is written left and right of the bars takes what it needs, and no more than a share of the width.
double room_for(const BarPlot& plot, std::string Bar::*text, double share) {
    double room = 0.0;
    for (const Bar& bar : plot.bars) room = std::max(room, text_width(bar.*text));
    return std::min(room, share * plot.width) + kGap + kEdge;
}

size_t part_colour(const BarPlot& plot, size_t part) {
    return part < plot.part_colours.size() ? plot.part_colours[part] : part;
}

std::string bar(const BarPlot& plot, size_t i, const Scale& x, double y) {
    const Bar& b = plot.bars[i];
    const double middle = y + 0.5 * kBarHeight;
    std::string content;
    double sum = 0.0;
    for (size_t part = 0; part < b.parts.size(); ++part) {
        const double next = sum + b.parts[part];
        const std::string name = part < plot.part_names.size() ? b.name + ", " + plot.part_names[part] : b.name;
        content += rectangle("part " + colour_class(plot.by_part ? part_colour(plot, part) : i), x.at(sum), y,
                             x.at(next) - x.at(sum), kBarHeight, fmt::format("{}: {:.4g}", name, b.parts[part]));
        sum = next;
    }
    if (b.error > 0.0) content += line("error", x.at(std::max(0.0, sum - b.error)), middle, x.at(sum + b.error), middle);
    if (b.floor) content += line("floor dots", x.at(*b.floor), y - 3.0, x.at(*b.floor), y + kBarHeight + 3.0);
    content += label("name left", x.from() - kGap, middle + 4.0, shortened(b.name, x.from() - kGap - kEdge));
    return content + label("value", x.at(sum + b.error) + kGap, middle + 4.0, b.value);
}

std::vector<LegendEntry> entries_of(const BarPlot& plot) {
    using Kind = LegendEntry::Kind;
    std::vector<LegendEntry> entries;
    for (size_t i = 0; i < plot.part_names.size(); ++i)
        entries.push_back({Kind::part, part_colour(plot, i), plot.part_names[i]});
    if (!plot.floor_name.empty()) entries.push_back({Kind::dots, 0, plot.floor_name});
    if (plot.line && !plot.line_name.empty()) entries.push_back({Kind::floor, 0, plot.line_name});
    return entries;
}

}  // namespace

Plot bar_plot(const BarPlot& plot) {
    double most = plot.line.value_or(0.0);
    for (const Bar& b : plot.bars) most = std::max({most, sum_of(b) + b.error, b.floor.value_or(0.0)});
    const double bottom = kTop + kBarStep * static_cast<double>(plot.bars.size());
    const Scale x = Scale::linear(most, room_for(plot, &Bar::name, 0.3), plot.width - room_for(plot, &Bar::value, 0.2));

    std::string content;
    double free_from = 0.0;
    for (const double tick : x.ticks()) {
        const double place = x.at(tick), half = 0.5 * text_width(tick_text(tick));
        content += line(tick == 0.0 ? "axis" : "grid", place, kTop, place, bottom);
        if (place - half < free_from) continue;
        content += label("tick below", place, bottom + 18.0, tick_text(tick));
        free_from = place + half + 6.0;
    }
    content += label("title below", 0.5 * (x.from() + x.to()), bottom + 38.0, plot.x_title);
    for (size_t i = 0; i < plot.bars.size(); ++i)
        content += bar(plot, i, x, kTop + kBarStep * static_cast<double>(i) + 0.5 * (kBarStep - kBarHeight));
    if (plot.line) content += line("floor", x.at(*plot.line), kTop, x.at(*plot.line), bottom);
    const Legend below = legend(entries_of(plot), 16.0, bottom + kBottom + 4.0, plot.width - 32.0);
    const double height = bottom + kBottom + (below.height > 0.0 ? below.height + 8.0 : 0.0);
    return {"bars", plot.title, plot.width, height, content + below.content};
}

}  // namespace gnomon::html
