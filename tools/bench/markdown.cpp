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

std::string range(const timing::Summary& summary, int digits) {
    return fixed(summary.least, digits) + " to " + fixed(summary.most, digits);
}

std::string mebibytes(uint64_t bytes) { return fixed(static_cast<double>(bytes) / (1u << 20), 1); }

std::string line(const Cells& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
}

// A table whose first column is left-aligned and the others right-aligned; nothing where there are no rows.
std::string table(const std::string& title, const Cells& head, const std::vector<Cells>& rows) {
    if (rows.empty()) return {};
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

// Medians of both programs and their ratios, without spreads.
Cells medians(const Row& row) {
    const bool made = row.refusal.empty();
    const auto of_gnomon = [&](const timing::Summary& summary, int digits) {
        return made ? fixed(summary.median, digits) : "-";
    };
    return {of_gnomon(row.gnomon.wall, 4), fixed(row.embree.wall.median, 4), of_gnomon(row.ratio, 2),
            of_gnomon(row.gnomon.cpu, 3),  fixed(row.embree.cpu.median, 3),  of_gnomon(row.cpu_ratio, 2)};
}

const Cells kMedians = {"gnomon, s", "Embree, s", "Embree / gnomon", "gnomon, CPU s", "Embree, CPU s", "ratio of CPU s"};

std::string times_table(const std::vector<Row>& rows) {
    Cells head = {"scene", "spp"};
    head.insert(head.end(), kMedians.begin(), kMedians.end());
    const Cells rest = {"gnomon, least to most", "Embree, least to most",
                        "ratio, least to most",  "load, s",
                        "first frame, s",        "peer",
                        "hits agree, %",         "shadows agree, %",
                        "peer's colour off, %",  "peer's visibility off, %"};
    head.insert(head.end(), rest.begin(), rest.end());
    return table("Whole frames", head, for_each_row(rows, [](const Row& row) {
                     const bool made = row.refusal.empty();
                     Cells cells = medians(row);
                     cells.push_back(made ? range(row.gnomon.wall, 4) : "-");
                     cells.push_back(range(row.embree.wall, 4));
                     cells.push_back(made ? range(row.ratio, 2) : "-");
                     cells.push_back(made ? fixed(row.load_seconds, 3) : "-");
                     cells.push_back(made ? fixed(row.first_seconds, 3) : "-");
                     cells.push_back(name_of(row.build) + ", " + name_of(row.rays));
                     cells.push_back(made ? fixed(100.0 * row.agreement.hit_share(), 4) : "-");
                     cells.push_back(made ? fixed(100.0 * row.agreement.shadow_share(), 4) : "-");
                     cells.push_back(fixed(100.0 * row.peer_errors.colour, 4));
                     cells.push_back(fixed(100.0 * row.peer_errors.visibility, 4));
                     return cells;
                 }));
}

// A table for each growth curve that has rows.
std::string growth_tables(const std::vector<Row>& rows) {
    std::string text;
    std::vector<std::string> groups;
    for (const Row& row : rows) {
        if (row.value > 0.0 && std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
    }
    for (const std::string& group : groups) {
        Cells head = {"scene", group};
        head.insert(head.end(), kMedians.begin(), kMedians.end());
        std::vector<Cells> lines;
        for (const Row& row : rows) {
            if (row.group != group) continue;
            Cells cells = medians(row);
            cells.insert(cells.begin(), {row.scene.substr(0, row.scene.find('@')), fixed(growth_value(row), 0)});
            lines.push_back(std::move(cells));
        }
        text += table("Growth with " + group, head, lines);
    }
    return text;
}

std::string refusals(const std::vector<Row>& rows) {
    std::string text;
    for (const Row& row : rows) {
        if (!row.refusal.empty()) text += "- " + row.scene + ": " + row.refusal + "\n";
    }
    return text.empty() ? text : "Refused:\n\n" + text + "\n";
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
                                "; pages: " + s.pages +
                                ". Medians of frames of a loaded scene, from its poses to the film in host memory.\n\n";
    std::vector<Row> made;
    for (const Row& row : rows) {
        if (row.refusal.empty()) made.push_back(row);
    }
    return heading + times_table(rows) + refusals(rows) + growth_tables(rows) + work_table(made) +
           stages_table("Seconds per stage, gnomon", made, &Row::gnomon) +
           stages_table("Seconds per stage, Embree", rows, &Row::embree) + yardsticks_table(made) + buffers_table(made);
}

}  // namespace gnomon::bench
