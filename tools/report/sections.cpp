// SPDX-License-Identifier: Apache-2.0
// What a report tells, in its order.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>

#include "report/report_page.hpp"
#include "report/tables.hpp"

namespace gnomon::report {
namespace {

std::vector<FigureGroup> one_group(std::vector<Figure> figures) {
    std::vector<FigureGroup> groups;
    if (!figures.empty()) groups.push_back({"", std::move(figures)});
    return groups;
}

/// How far apart the method finds the baseline and itself.
std::string again_note(const std::vector<BenchFile>& files) {
    size_t rows = 0, called_different = 0;
    double least = 1.0, most = 1.0;
    for (const BenchFile& file : files) {
        for (const Comparison& c : file.comparisons) {
            if (!file.cases[c.of].again) continue;
            least = rows == 0 ? c.ratio : std::min(least, c.ratio);
            most = rows == 0 ? c.ratio : std::max(most, c.ratio);
            ++rows;
            called_different += c.verdict == Verdict::faster || c.verdict == Verdict::slower ? 1 : 0;
        }
    }
    if (rows == 0)
        return "The baseline was not measured a second time, so nothing says what the method itself cannot tell apart.";
    return fmt::format(
        "The A/A row is the baseline, measured a second time as if it were another layout: its {} ratios lie between {:.3f} "
        "and "
        "{:.3f}, and {} of them came out as faster or slower. Ratios nearer to 1 than these are what the method cannot tell "
        "apart.",
        rows, least, most, called_different);
}

/// In how many settings each layout has the fastest query.
std::string winners(const std::vector<BenchFile>& files) {
    std::map<std::string, size_t> wins;
    size_t settings = 0;
    for (const BenchFile& file : files) {
        for (const Setting& setting : settings_of(file)) {
            const Case* best = nullptr;
            for (const Case* c : setting.cases)
                if (!c->again && !answers_less(*c) &&
                    (best == nullptr || c->stage("query")->median < best->stage("query")->median))
                    best = c;
            if (best == nullptr) continue;
            ++settings;
            ++wins[best->layout];
        }
    }
    std::vector<std::pair<size_t, std::string>> order;
    for (const auto& [layout, count] : wins) order.emplace_back(count, layout);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (const auto& [count, layout] : order) text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", layout, count);
    return text.empty() ? "" : fmt::format("The least median of the query, of {} settings: {}. ", settings, text);
}

Section verdicts(const Sources& sources) {
    Section section{.id = "verdicts",
                    .title = "Verdicts",
                    .note = winners(sources.files()) + again_note(sources.files()),
                    .nothing = "Nothing was compared."};
    if (DataTable summary = summary_table(sources.files()); !summary.rows.empty()) section.tables.push_back(std::move(summary));
    for (const std::string& stage : compared_stages(sources.files())) {
        section.tables.push_back(verdict_table(sources.files(), stage));
        section.groups.push_back({"The " + stage, ratio_figures(sources, stage), !section.groups.empty()});
    }
    return section;
}

Section with_table(Section section, DataTable table) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
    return section;
}

Section axes(const Sources& sources) {
    Section section{.id = "axes", .title = "Along the axes", .nothing = "No axis has more than one value."};
    for (const char* stage : {"query", "build"})
        if (std::vector<Figure> figures = sweep_figures(sources, stage); !figures.empty())
            section.groups.push_back({std::string("The ") + stage, std::move(figures)});
    return section;
}

}  // namespace

std::vector<Section> sections_of(const std::vector<BenchFile>& files) {
    const Sources sources(files);
    std::vector<Section> sections = {verdicts(sources)};
    if (files.size() > 1)
        sections.push_back(
            with_table({.id = "files", .title = "The files side by side", .nothing = "The files have no case in common."},
                       files_table(files)));
    sections.push_back(
        with_table({.id = "stages", .title = "Stages", .groups = one_group(stage_figures(sources))}, times_table(files)));
    sections.push_back(axes(sources));
    sections.push_back(with_table({.id = "bytes",
                                   .title = "Bytes and query time",
                                   .groups = one_group(front_figures(sources)),
                                   .nothing = "The bytes of the maps were not counted."},
                                  front_table(files)));
    sections.push_back(with_table({.id = "counts",
                                   .title = "Counts per query",
                                   .groups = one_group(count_figures(sources)),
                                   .nothing = "Nothing was counted in this run."},
                                  counts_table(files)));
    sections.push_back({.id = "lists",
                        .title = "Lengths of lists",
                        .groups = one_group(length_figures(sources)),
                        .nothing = "The lengths of lists were not counted in this run."});
    sections.push_back({.id = "texels",
                        .title = "Ranges per texel",
                        .groups = one_group(texel_figures(sources)),
                        .nothing = "Ranges per texel were not counted in this run."});
    sections.push_back(
        with_table({.id = "skipped", .title = "Skipped", .nothing = "No case was skipped."}, skipped_table(files)));
    return sections;
}

}  // namespace gnomon::report
