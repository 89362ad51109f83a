// SPDX-License-Identifier: Apache-2.0
// What was measured of a figure, as JSON.
#include "reproduce/report.hpp"

namespace gnomon::reproduce {
namespace {

io::Json estimate_json(const Estimate& estimate) {
    return {{"value", estimate.value}, {"standard_error", estimate.standard_error}};
}

io::Json claims_json(const std::vector<ClaimResult>& claims) {
    io::Json json = io::Json::array();
    for (const ClaimResult& claim : claims) {
        io::Json checks = io::Json::array();
        for (const Check& check : claim.checks)
            checks.push_back({{"scene", check.scene},
                              {"statement", check.statement},
                              {"measured", check.measured},
                              {"verdict", to_text(check.verdict)}});
        json.push_back({{"quote", claim.quote},
                        {"source", claim.source},
                        {"run", claim.run},
                        {"verdict", to_text(claim.verdict)},
                        {"checks", checks}});
    }
    return json;
}

io::Json run_json(const Run& run, const RunResult& result) {
    io::Json metrics_of_run = io::Json::object(), stages = io::Json::array();
    for (const MetricInfo& m : metrics())
        if (const auto found = result.metrics.find(m.metric); found != result.metrics.end())
            metrics_of_run[m.key] = estimate_json(found->second);
    for (const StageMean& stage : result.stages)
        stages.push_back({{"name", stage.name},
                          {"seconds", estimate_json(stage.seconds)},
                          {"map_seconds", estimate_json(stage.map_seconds)}});
    return {{"label", run.label},
            {"method", run.method},
            {"parameters", run.parameters},
            {"effective", result.frame.effective},
            {"metrics", metrics_of_run},
            {"stages", stages},
            {"buffers", result.frame.stats.buffer_bytes},
            {"peak_bytes", result.frame.stats.peak_bytes},
            {"counts", result.frame.stats.counts}};
}

}  // namespace

io::Json to_json(const FigureReport& report) {
    const Experiment& experiment = *report.figure.experiment;
    io::Json json = io::document("reproduce");
    json["figure"] = report.figure.name;
    json["title"] = report.figure.title;
    json["paper"] = paper_of(report.figure.name);
    json["shows"] = report.figure.shows;
    json["device"] = report.device;
    json["scale"] = report.options.scale;
    json["repeat"] = report.options.repeat;
    json["reference_spp"] = report.options.reference_spp;
    json["claims"] = claims_json(report.claims);
    json["axis"] = experiment.axis;
    json["settings"] = io::Json::array();
    for (size_t i = 0; i < experiment.settings.size(); ++i) {
        const SettingResult& setting = report.result.settings[i];
        io::Json runs = io::Json::array();
        for (size_t r = 0; r < experiment.runs.size(); ++r) runs.push_back(run_json(experiment.runs[r], setting.runs[r]));
        json["settings"].push_back({{"scene", experiment.settings[i].scene},
                                    {"x", experiment.settings[i].x},
                                    {"width", setting.settings.width},
                                    {"height", setting.settings.height},
                                    {"spp", setting.settings.spp},
                                    {"shadow_res", setting.settings.shadow_res},
                                    {"segments", experiment.settings[i].segments},
                                    {"triangles", setting.triangles},
                                    {"runs", runs}});
    }
    return json;
}

}  // namespace gnomon::reproduce
