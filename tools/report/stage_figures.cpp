// SPDX-License-Identifier: Apache-2.0
// Stacked stages by layout.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "html/bar_plot.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {
namespace {

struct Stage {
    const char* name;
    size_t colour;
};
constexpr Stage kStages[] = {{"clear", 7}, {"count", 4}, {"scan", 3}, {"prepare", 5}, {"fill", 2}, {"finish", 1}, {"query", 0}};

/// Those that took time in some case.
std::vector<Stage> stages_of(const BenchFile& file) {
    std::vector<Stage> stages(std::begin(kStages), std::end(kStages));
    std::erase_if(stages, [&](const Stage& stage) {
        return std::none_of(file.cases.begin(), file.cases.end(), [&](const Case& c) {
            const Times* times = c.stage(stage.name);
            return times != nullptr && times->median > 0.0;
        });
    });
    return stages;
}

double sum_of(const html::Bar& bar) { return std::accumulate(bar.parts.begin(), bar.parts.end(), 0.0); }

html::Bar bar_of(const Case& c, const std::vector<Stage>& stages) {
    html::Bar bar{
        .name = c.row_name(), .parts = {}, .value = {}, .floor = c.copy_ms && *c.copy_ms > 0.0 ? c.copy_ms : std::nullopt};
    for (const Stage& stage : stages) {
        const Times* times = c.stage(stage.name);
        bar.parts.push_back(times != nullptr ? times->median : 0.0);
    }
    bar.value = shown(sum_of(bar)) + " ms";
    return bar;
}

std::string caption_of(const html::BarPlot& plot) {
    std::string caption;
    const auto is_left_out = [](const html::Bar& bar) { return bar.name == kNullLayout || bar.name.ends_with(", again"); };
    const auto first = std::find_if_not(plot.bars.begin(), plot.bars.end(), is_left_out);
    if (first != plot.bars.end()) {
        const auto last = std::find_if_not(plot.bars.rbegin(), plot.bars.rend(), is_left_out);
        const double whole = sum_of(*last);
        caption =
            fmt::format("Building and one query of {} take least, {}; of {} most, {}, {:.0f} % of it the query.", first->name,
                        first->value, last->name, last->value, whole > 0.0 ? 100.0 * last->parts.back() / whole : 0.0);
    }
    caption += " Parts are medians, so their sum need not be the median of the whole.";
    if (!plot.floor_name.empty()) caption += " Dotted: what copying the bytes of the map takes on this device.";
    if (plot.line) caption += " Dashed: the null layout, which counts and keeps nothing.";
    return caption;
}

}  // namespace

std::vector<Figure> stage_figures(const Sources& sources) {
    std::vector<Figure> figures;
    for (const BenchFile& file : sources.files()) {
        const std::vector<Stage> stages = stages_of(file);
        for (const Setting& setting : settings_of(file)) {
            html::BarPlot plot{.title = sources.title(file, setting.title()),
                               .x_title = "ms, medians",
                               .by_part = true,
                               .line_name = "null layout",
                               .width = 480.0};
            for (const Stage& stage : stages) {
                plot.part_names.emplace_back(stage.name);
                plot.part_colours.push_back(stage.colour);
            }
            for (const Case* c : setting.cases) {
                plot.bars.push_back(bar_of(*c, stages));
                if (c->copy_ms) plot.floor_name = "copy of as many bytes";
                if (c->layout == kNullLayout) plot.line = sum_of(plot.bars.back());
            }
            std::stable_sort(plot.bars.begin(), plot.bars.end(),
                             [](const html::Bar& a, const html::Bar& b) { return sum_of(a) < sum_of(b); });
            figures.push_back(
                {sources.name(file, "stages", setting.title()), html::bar_plot(plot), caption_of(plot), setting.is_first});
        }
    }
    return figures;
}

}  // namespace gnomon::report
