// SPDX-License-Identifier: Apache-2.0
// What was measured of a figure, as a page to read.
#include "reproduce/report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "html/bar_plot.hpp"
#include "html/html.hpp"
#include "html/line_plot.hpp"
#include "html/page.hpp"
#include "reproduce/page.hpp"
#include "reproduce/viewer.hpp"

namespace gnomon::reproduce {
namespace {

using namespace html;

struct Part {
    const char* name;
    double seconds;
};

// The parts of a frame that papers tell apart.
std::vector<Part> parts_of(const RunResult& run) {
    Part map{"shadow map", 0.0}, camera{"camera samples", 0.0}, test{"shadow tests", 0.0}, shade{"shading", 0.0};
    for (const StageMean& stage : run.stages) {
        map.seconds += stage.map_seconds.value;
        Part& part = stage.name == "sample/shadow" ? test : stage.name == "sample/shade" ? shade : camera;
        part.seconds += stage.seconds.value - stage.map_seconds.value;
    }
    return {map, camera, test, shade};
}

std::string place(const Experiment& experiment, size_t setting) {
    const Setting& s = experiment.settings[setting];
    return experiment.axis.empty() ? s.scene : fmt::format("{}, {:g} {}", s.scene, s.x, experiment.axis);
}

std::vector<std::string> labels_of(const Experiment& experiment) {
    std::vector<std::string> labels;
    for (const Run& run : experiment.runs) labels.push_back(run.label);
    return labels;
}

std::string plot_title(Metric metric) {
    const MetricInfo& m = info(metric);
    return m.plot_unit.name.empty() ? m.title : m.title + ", " + m.plot_unit.name;
}

// Curves for each scene, or bars for each setting.
std::string metric_plots(const Experiment& experiment, const ExperimentResult& result, Metric metric) {
    std::string plots;
    for (size_t first = 0; first < experiment.settings.size();) {
        const std::string& scene = experiment.settings[first].scene;
        size_t end = first + 1;
        while (!experiment.axis.empty() && end < experiment.settings.size() && experiment.settings[end].scene == scene) ++end;
        std::vector<PlotSeries> series;
        std::vector<Bar> bars;
        for (size_t r = 0; r < experiment.runs.size(); ++r) {
            PlotSeries& curve = series.emplace_back(PlotSeries{experiment.runs[r].label, {}});
            for (size_t i = first; i < end; ++i) {
                const auto& metrics = result.settings[i].runs[r].metrics;
                const auto found = metrics.find(metric);
                if (found == metrics.end()) continue;
                const Unit& unit = info(metric).plot_unit;
                const Estimate shown_value{found->second.value / unit.size, found->second.standard_error / unit.size};
                curve.points.push_back({experiment.settings[i].x, shown_value.value, shown_value.standard_error});
                bars.push_back({experiment.runs[r].label,
                                {shown_value.value},
                                shown_value.standard_error,
                                shown({shown_value.value, 0.0}) + (unit.name.empty() ? "" : " " + unit.name)});
            }
        }
        const std::string title = fmt::format("{}: {}", scene, info(metric).title);
        plots += experiment.axis.empty()
                     ? figure(bar_plot({.title = title, .x_title = plot_title(metric), .bars = bars}))
                     : figure(line_plot(
                           {.title = title, .x_title = experiment.axis, .y_title = plot_title(metric), .series = series}));
        first = end;
    }
    return plots;
}

// Errors against seconds: what a method reaches in the same time, and how long it takes to the same error.
std::string time_plots(const Experiment& experiment, const ExperimentResult& result, Metric metric) {
    std::string plots;
    std::vector<std::string> names;
    for (size_t i = 0; i < experiment.settings.size(); ++i) {
        std::vector<PlotSeries> series;
        for (size_t r = 0; r < experiment.runs.size(); ++r) {
            const Run& run = experiment.runs[r];
            const std::string& name = run.curve.empty() ? run.label : run.curve;
            auto curve = std::find_if(series.begin(), series.end(), [&](const PlotSeries& s) { return s.name == name; });
            if (curve == series.end()) curve = series.insert(series.end(), {name, {}});
            const auto& metrics = result.settings[i].runs[r].metrics;
            const Estimate error = metrics.at(metric);
            const double unit = info(metric).plot_unit.size;
            curve->points.push_back({metrics.at(Metric::seconds).value * 1e3, error.value / unit, error.standard_error / unit});
        }
        names.clear();
        for (PlotSeries& s : series) {
            std::sort(s.points.begin(), s.points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
            names.push_back(s.name);
        }
        plots += figure(line_plot(
            {.title = place(experiment, i), .x_title = "frame, ms", .y_title = plot_title(metric), .series = series}));
    }
    return legend_list(names) + element("div", {{"class", "plots"}}, plots);
}

bool has_curves(const Experiment& experiment) {
    return std::any_of(experiment.runs.begin(), experiment.runs.end(), [](const Run& run) { return !run.curve.empty(); });
}

std::string stage_plots(const Experiment& experiment, const ExperimentResult& result) {
    std::string plots;
    std::vector<std::string> names;
    for (size_t i = 0; i < experiment.settings.size(); ++i) {
        std::vector<Bar> bars;
        for (size_t r = 0; r < experiment.runs.size(); ++r) {
            const RunResult& run = result.settings[i].runs[r];
            Bar bar{experiment.runs[r].label,
                    {},
                    0.0,
                    shown_with_unit(Metric::seconds, {run.metrics.at(Metric::seconds).value, 0.0})};
            names.clear();
            for (const Part& part : parts_of(run)) {
                bar.parts.push_back(part.seconds * 1e3);
                names.emplace_back(part.name);
            }
            bars.push_back(std::move(bar));
        }
        plots += figure(bar_plot({.title = place(experiment, i), .x_title = "ms", .bars = bars, .by_part = true}));
    }
    return legend_list(names) + element("div", {{"class", "plots"}}, plots);
}

std::string metric_table(const Experiment& experiment, const ExperimentResult& result) {
    std::vector<Metric> columns;
    for (const MetricInfo& m : metrics())
        for (const SettingResult& setting : result.settings)
            for (const RunResult& run : setting.runs)
                if (run.metrics.contains(m.metric) && (columns.empty() || columns.back() != m.metric))
                    columns.push_back(m.metric);
    std::vector<std::string> head = {"run"};
    for (const Metric column : columns)
        head.push_back(escaped(info(column).title) + element("small", escaped(info(column).unit.name)));
    std::string html;
    for (size_t i = 0; i < result.settings.size(); ++i) {
        Table table(head);
        for (size_t r = 0; r < experiment.runs.size(); ++r) {
            std::vector<std::string> cells = {escaped(experiment.runs[r].label)};
            for (const Metric column : columns) {
                const auto& metrics = result.settings[i].runs[r].metrics;
                const auto found = metrics.find(column);
                cells.push_back(found == metrics.end() ? "–" : escaped(shown(column, found->second)));
            }
            table.add(cells);
        }
        const SettingResult& setting = result.settings[i];
        const std::string note =
            fmt::format("{} triangles, {}×{} pixels, {} samples per pixel, maps of {}² texels", setting.triangles,
                        setting.settings.width, setting.settings.height, setting.settings.spp, setting.settings.shadow_res);
        html += heading(3, place(experiment, i)) + element("p", {{"class", "note"}}, escaped(note)) + table.html();
    }
    return html;
}

std::string milliseconds(const Estimate& seconds) { return escaped(shown(Metric::seconds, seconds)); }

// Every stage, buffer and count of a run.
std::string run_details(const RunResult& run) {
    Table stages({"stage", "ms", "of which for the map"});
    for (const StageMean& stage : run.stages)
        stages.add({escaped(stage.name), milliseconds(stage.seconds),
                    stage.map_seconds.value > 0.0 ? milliseconds(stage.map_seconds) : ""});
    Table buffers({"buffer", "bytes"});
    for (const auto& [name, bytes] : run.frame.stats.buffer_bytes) buffers.add({escaped(name), std::to_string(bytes)});
    buffers.add({"peak of all", std::to_string(run.frame.stats.peak_bytes)});
    Table counts({"count", ""});
    for (const auto& [name, count] : run.frame.stats.counts) counts.add({escaped(name), std::to_string(count)});
    for (const auto& [name, value] : run.frame.effective) counts.add({escaped(name), escaped(value)});
    return element("div", {{"class", "columns"}}, stages.html() + buffers.html() + counts.html());
}

std::string details(const Experiment& experiment, const ExperimentResult& result) {
    std::string html;
    for (size_t i = 0; i < result.settings.size(); ++i)
        for (size_t r = 0; r < experiment.runs.size(); ++r)
            html += element("details", element("summary", escaped(place(experiment, i) + ": " + experiment.runs[r].label)) +
                                           run_details(result.settings[i].runs[r]));
    return html;
}

constexpr const char* kHowMeasured =
    "Figures are means over seeds, ± the standard error of the mean. False shadow and false light are shares of the shadow "
    "tests, compared one by one with those that were ray-traced at the same samples; excess shadow is their difference: a "
    "coarse map makes the edges of shadows wrong both ways alike, self-shadowing does not. RMSE of visibility and FLIP are "
    "against the converged reference and hold the camera's noise too; noise of visibility is the root of its mean variance "
    "between seeds, and error without noise what it leaves of the RMSE. Times are the device's, without reading the scene "
    "and writing files. The shadow map is what the shadow tests read: ranges and their lists, or depths. Where pictures are "
    "compared or ranges are shown, maps have their full size at any scale. Sides of a comparison are compared seed by seed, "
    "and errors and noise pixel by pixel as well. A claim is undecided where they are no further apart than chance brings "
    "equal ones in 95 of 100 cases (Student's t).";

}  // namespace

std::string to_html(const FigureReport& report) {
    const Figure& figure = report.figure;
    const Experiment& experiment = *figure.experiment;
    const ExperimentResult& result = report.result;
    std::string content = element("div", {{"class", "paper"}}, escaped(paper_of(figure.name))) + "\n" +
                          element("h1", escaped("Figure " + figure.name + ": " + figure.title)) +
                          element("p", escaped(figure.shows)) + measured_on(report.options, report.device);
    if (!report.claims.empty()) content += heading(2, "Claims") + claims_table(report.claims);
    if (experiment.with_reference) {
        content +=
            heading(2, "Pictures") +
            element("p", {{"class", "note"}},
                    "Wheel: zoom. Drag: pan. Click on the large picture or space: flip to the reference and back. Arrows or "
                    "digits: other pictures.");
        for (size_t i = 0; i < result.settings.size(); ++i) {
            if (result.settings.size() > 1) content += heading(3, place(experiment, i));
            content += picture_viewer(experiment, result.settings[i]);
        }
    }
    if (experiment.texel_ranges) {
        content +=
            heading(2, "Ranges per texel") +
            element(
                "p", {{"class", "note"}},
                "Of the light's view, over the whole shutter. A range that a method cuts where a cell of time ends counts in "
                "each cell.");
        for (size_t i = 0; i < result.settings.size(); ++i)
            content += heading(3, place(experiment, i)) + heat_map_viewer(experiment, result.settings[i]);
    }
    if (!figure.plots.empty()) {
        std::string plots;
        for (const Metric metric : figure.plots) plots += metric_plots(experiment, result, metric);
        content += heading(2, "Plots") + (experiment.axis.empty() ? "" : legend_list(labels_of(experiment))) +
                   element("div", {{"class", "plots"}}, plots);
    }
    if (experiment.with_reference && has_curves(experiment))
        content += heading(2, "Error against time") + time_plots(experiment, result, Metric::error);
    if (figure.stage_plot) content += heading(2, "Times per stage") + stage_plots(experiment, result);
    content += heading(2, "Measured") + metric_table(experiment, result);
    content += heading(2, "Details") + details(experiment, result);
    content += heading(2, "How it is measured") + element("p", kHowMeasured);
    return figure_page("Figure " + figure.name + ": " + figure.title, content);
}

}  // namespace gnomon::reproduce
