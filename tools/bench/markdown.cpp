// SPDX-License-Identifier: Apache-2.0
// The rows of a benchmark as Markdown tables.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "bench/report.hpp"

namespace gnomon::bench {
namespace {

using Cells = std::vector<std::string>;

constexpr size_t kListedBuffers = 5;

std::string fixed(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", digits, value);
    const bool negative_zero = std::strtod(text, nullptr) == 0.0 && text[0] == '-';
    return negative_zero ? text + 1 : text;
}

std::string fixed(const std::optional<double>& value, int digits, double unit = 1.0) {
    return value ? fixed(*value / unit, digits) : "-";
}

std::string spread(const Summary& summary, int digits) {
    return fixed(summary.median, digits) + " (" + fixed(summary.min, digits) + " to " + fixed(summary.max, digits) + ")";
}

std::string mebibytes(uint64_t bytes) { return fixed(static_cast<double>(bytes) / (1u << 20), 1); }

std::string line(const Cells& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
}

// A table whose first column is left-aligned and the others right-aligned.
std::string table(const std::string& title, const Cells& head, const std::vector<Cells>& rows) {
    std::string text = "### " + title + "\n\n" + line(head) + "| --- |";
    for (size_t i = 1; i < head.size(); ++i) text += " ---: |";
    text += "\n";
    for (const Cells& row : rows) text += line(row);
    return text + "\n";
}

template <class MakeCells>
std::vector<Cells> for_each_row(const std::vector<Row>& rows, MakeCells make) {
    std::vector<Cells> result;
    for (const Row& row : rows) {
        Cells cells = {row.scene, std::to_string(row.settings.spp)};
        for (std::string& cell : make(row)) cells.push_back(std::move(cell));
        result.push_back(std::move(cells));
    }
    return result;
}

std::string times_table(const std::vector<Row>& rows) {
    return table("Whole frames",
                 {"scene", "spp", "gnomon, s", "Embree, s", "segments", "Embree / gnomon", "gnomon, CPU s", "Embree, CPU s",
                  "ratio of CPU s", "hits agree, %", "shadows agree, %"},
                 for_each_row(rows, [](const Row& row) -> Cells {
                     return {spread(row.gnomon.wall, 3),
                             spread(row.embree.wall, 3),
                             std::to_string(row.embree_segments),
                             spread(row.ratio, 2),
                             fixed(row.gnomon.cpu.median, 3),
                             fixed(row.embree.cpu.median, 3),
                             fixed(row.cpu_ratio.median, 2),
                             fixed(100.0 * row.agreement.hit_share(), 4),
                             fixed(100.0 * row.agreement.shadow_share(), 4)};
                 }));
}

std::string work_table(const std::vector<Row>& rows) {
    return table("Work",
                 {"scene", "spp", "prisms", "camera entries", "light entries", "ranges", "tests / sample", "core-ns / 8 tests",
                  "Mranges / s", "visited / shadow test", "tested / shadow test", "peak, MiB"},
                 for_each_row(rows, [](const Row& row) -> Cells {
                     const Work& work = row.work;
                     const auto count = [&](const char* name) { return std::to_string(row.gnomon_stats.counts.at(name)); };
                     return {count("prisms"),
                             count("bin_entries.camera"),
                             std::to_string(work.light_entries),
                             std::to_string(work.ranges),
                             fixed(work.tests_per_sample, 1),
                             fixed(work.core_ns_per_8_tests, 1),
                             fixed(work.ranges_per_second, 2, 1e6),
                             fixed(work.visited_per_shadow_test, 2),
                             fixed(work.tested_per_shadow_test, 2),
                             mebibytes(row.gnomon_stats.peak_bytes)};
                 }));
}

// A column for each stage that any row has.
std::string stages_table(const std::string& title, const std::vector<Row>& rows, Timing Row::*program) {
    Cells names;
    for (const Row& row : rows) {
        for (const FrameStats::Stage& stage : (row.*program).stages) {
            if (std::find(names.begin(), names.end(), stage.name) == names.end()) names.push_back(stage.name);
        }
    }
    Cells head = {"scene", "spp"};
    head.insert(head.end(), names.begin(), names.end());
    head.push_back("the rest");
    return table(title, head, for_each_row(rows, [&](const Row& row) {
                     const Timing& timing = row.*program;
                     Cells cells;
                     for (const std::string& name : names) cells.push_back(fixed(seconds_of(timing.stages, {name}), 4));
                     cells.push_back(fixed(timing.rest.median, 4));
                     return cells;
                 }));
}

std::string yardsticks_table(const std::vector<Row>& rows) {
    const auto times = [](double seconds, const std::optional<double>& yardstick) {
        return yardstick && *yardstick > 0.0 ? fixed(seconds / *yardstick, 2) : std::string("-");
    };
    return table("Yardsticks", {"scene", "spp", "trace, s", "yardstick, s", "times", "raster, s", "yardstick, s", "times"},
                 for_each_row(rows, [&](const Row& row) -> Cells {
                     const double trace = seconds_of(row.gnomon.stages, {"sample/trace"});
                     const double raster = seconds_of(row.gnomon.stages, {"raster/count", "raster/fill"});
                     return {fixed(trace, 4),
                             fixed(row.work.trace_yardstick_seconds, 4),
                             times(trace, row.work.trace_yardstick_seconds),
                             fixed(raster, 4),
                             fixed(row.work.raster_yardstick_seconds, 4),
                             times(raster, row.work.raster_yardstick_seconds)};
                 }));
}

std::string buffers_table(const std::vector<Row>& rows) {
    return table("Largest buffers, MiB", {"scene", "spp", "buffers"}, for_each_row(rows, [](const Row& row) -> Cells {
                     std::vector<std::pair<uint64_t, std::string>> buffers;
                     for (const auto& [name, bytes] : row.gnomon_stats.buffer_bytes) buffers.emplace_back(bytes, name);
                     std::sort(buffers.rbegin(), buffers.rend());
                     std::string list;
                     for (size_t i = 0; i < std::min(kListedBuffers, buffers.size()); ++i) {
                         list += (i > 0 ? ", " : "") + buffers[i].second + " " + mebibytes(buffers[i].first);
                     }
                     return {list};
                 }));
}

}  // namespace

std::string to_markdown(const Context& context, const std::vector<Row>& rows) {
    const Settings& s = context.settings;
    const std::string heading = std::to_string(s.width) + "x" + std::to_string(s.height) + " pixels, light views of " +
                                std::to_string(s.shadow_res) + " texels, " + std::to_string(s.threads) + " threads, " +
                                std::to_string(s.repeat) + " pairs; " + context.device.name + ", " + context.device.driver +
                                ". Medians (least to most).\n\n";
    return heading + times_table(rows) + work_table(rows) + stages_table("Seconds per stage, gnomon", rows, &Row::gnomon) +
           stages_table("Seconds per stage, Embree", rows, &Row::embree) + yardsticks_table(rows) + buffers_table(rows);
}

}  // namespace gnomon::bench
