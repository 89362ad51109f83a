// SPDX-License-Identifier: Apache-2.0
#include "bench_case.hpp"

#include <algorithm>

namespace gnomon::cli {

std::string axes_text(const AxisValues& axes, const std::string& separator) {
    std::string text;
    for (const auto& [name, value] : axes) text += (text.empty() ? "" : separator) + name + "=" + value;
    return text;
}

const std::vector<BenchMetric>& bench_stages() {
    // Prisms are made into fragments before these are counted.
    static const std::vector<BenchMetric> all = {
        {"clear", {"sbuffer/clear"}}, {"count", {"raster/count", "raster/count_fragments", "raster/fragments", "sbuffer/size"}},
        {"scan", {"sbuffer/scan"}},   {"prepare", {"sbuffer/prepare"}},
        {"fill", {"raster/fill"}},    {"finish", {"sbuffer/finish"}},
        {"query", {"sample/shadow"}}};
    return all;
}

const std::vector<std::string>& bench_metrics() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const BenchMetric& stage : bench_stages()) names.push_back(stage.name);
        names.insert(names.end(), {"build", "rest", "frame", "cpu"});
        return names;
    }();
    return all;
}

std::map<std::string, double> metrics_of(const FrameStats& stats, double cpu_seconds) {
    constexpr double kMilliseconds = 1e3;
    const double frame = stats.wall_seconds * kMilliseconds;
    std::map<std::string, double> metrics = {{"frame", frame}, {"cpu", cpu_seconds * kMilliseconds}};
    if (!stats.timed) return metrics;
    for (const BenchMetric& metric : bench_stages()) {
        double& sum = metrics[metric.name];
        for (const FrameStats::Stage& stage : stats.stages) {
            const bool belongs = std::find(metric.stages.begin(), metric.stages.end(), stage.name) != metric.stages.end();
            if (belongs) sum += stage.seconds * kMilliseconds;
        }
        if (metric.name != "query") metrics["build"] += sum;
    }
    metrics["rest"] = std::max(0.0, frame - metrics["build"] - metrics["query"]);
    return metrics;
}

}  // namespace gnomon::cli
