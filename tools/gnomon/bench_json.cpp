// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <gnomon/version.hpp>
#include <thread>

#include "bench_report.hpp"
#include "commit.hpp"
#include "timing/machine.hpp"
#include "timing/summary.hpp"

namespace gnomon::cli {

namespace {

using io::Json;
using timing::Summary;

Json context_json(const BenchResults& results) {
    return {{"date", timing::utc_now()},
            {"host_name", timing::host_name()},
            {"executable", results.command.front()},
            {"num_cpus", std::thread::hardware_concurrency()},
            {"mhz_per_cpu", std::lround(timing::cpu_mhz())},
            {"cpu_scaling_enabled", false},
            {"caches", Json::array()},
            {"load_avg", timing::load_average()},
            {"library_build_type", timing::build_type()},
            {"cpu", timing::cpu_name()},
            {"gnomon_version", GNOMON_VERSION},
            {"commit", kCommit},
            {"device", results.device.name},
            {"device_type", results.device.type},
            {"driver", results.device.driver_name.empty() ? results.device.driver : results.device.driver_name},
            {"driver_version", results.device.driver_version},
            {"vulkan", results.device.vulkan},
            {"command", results.command},
            {"seed", results.seed}};
}

/// The entries of Google Benchmark of one case and metric.
void add_entries(const BenchCase& measured, const std::string& metric, size_t family, size_t instance, Json& entries) {
    const auto found = measured.samples.find(metric);
    if (found == measured.samples.end()) return;
    const std::vector<double>&real = found->second, &cpu = measured.samples.at("cpu");
    const std::string name = measured.name + "/" + metric;
    const auto entry = [&](const std::string& suffix, const char* run_type) {
        return Json{{"name", name + suffix}, {"family_index", family}, {"per_family_instance_index", instance},
                    {"run_name", name},      {"run_type", run_type},   {"repetitions", real.size()},
                    {"threads", 1}};
    };
    for (size_t i = 0; i < real.size(); ++i) {
        Json json = entry("", "iteration");
        json.update(
            {{"repetition_index", i}, {"iterations", 1}, {"real_time", real[i]}, {"cpu_time", cpu[i]}, {"time_unit", "ms"}});
        entries.push_back(std::move(json));
    }
    const auto aggregate = [&](const std::string& of, double of_real, double of_cpu, const char* unit) {
        Json json = entry("_" + of, "aggregate");
        json.update({{"aggregate_name", of},
                     {"aggregate_unit", unit},
                     {"iterations", real.size()},
                     {"real_time", of_real},
                     {"cpu_time", of_cpu},
                     {"time_unit", "ms"}});
        entries.push_back(std::move(json));
    };
    const auto variation = [](const std::vector<double>& samples) {
        const double mean = timing::mean(samples);
        return mean > 0.0 ? timing::standard_deviation(samples) / mean : 0.0;
    };
    aggregate("mean", timing::mean(real), timing::mean(cpu), "time");
    aggregate("median", timing::summarize(real).median, timing::summarize(cpu).median, "time");
    aggregate("stddev", timing::standard_deviation(real), timing::standard_deviation(cpu), "time");
    aggregate("cv", variation(real), variation(cpu), "percentage");
}

Json stages_json(const BenchCase& measured) {
    Json json = Json::object();
    for (const std::string& metric : bench_metrics()) {
        const auto found = measured.samples.find(metric);
        if (found == measured.samples.end()) continue;
        const Summary summary = timing::summarize(found->second);
        json[metric] = {{"samples", summary.samples},
                        {"median", summary.median},
                        {"q1", summary.q1},
                        {"q3", summary.q3},
                        {"least", summary.least}};
    }
    return json;
}

/// 0, 1, 2 to 3, 4 to 7, ...
Json lengths_json(const std::vector<uint64_t>& lengths) {
    Json json = Json::array();
    for (uint64_t from = 0, to = 0; from < lengths.size(); from = to + 1) {
        to = from == 0 ? 0 : 2 * from - 1;
        uint64_t lists = 0;
        for (uint64_t n = from; n <= to && n < lengths.size(); ++n) lists += lengths[n];
        json.push_back({{"from", from}, {"to", to}, {"lists", lists}});
    }
    return json;
}

Json axes_json(const BenchResults& results) {
    Json layouts = Json::array();
    for (const BenchLayout& layout : results.layouts) layouts.push_back(layout.name);
    Json json = Json::array({{{"name", "layout"}, {"values", layouts}}});
    for (const Axis& axis : results.axes) json.push_back({{"name", axis.name}, {"values", axis.values}});
    return json;
}

Json case_json(const BenchResults& results, const BenchGroup& group, const BenchCase& measured) {
    Json axes = Json::object();
    for (const auto& [name, value] : group.axes) axes[name] = value;
    Json json = {{"name", measured.name},
                 {"scene", group.scene},
                 {"layout", measured.layout.name},
                 {"lossless", measured.layout.lossless},
                 {"axes", axes},
                 {"again", measured.layout.again},
                 {"stages", stages_json(measured)},
                 {"counts", Json::object()}};
    for (const auto& [name, value] : measured.counts) {
        const bool whole = value == std::floor(value) && std::abs(value) < 9e15;
        json["counts"][name] = whole ? Json(static_cast<int64_t>(value)) : Json(value);
    }
    if (!measured.lengths.empty()) json["lengths"] = lengths_json(measured.lengths);
    if (measured.texels.width > 0)
        json["texels"] = {
            {"width", measured.texels.width}, {"height", measured.texels.height}, {"ranges", measured.texels.ranges}};
    if (const auto bytes = measured.counts.find("map_bytes"); bytes != measured.counts.end())
        json["floor"] = {{"bytes", static_cast<int64_t>(bytes->second)},
                         {"copy_ms", 1e3 * bytes->second / results.copy_bytes_per_second}};
    if (measured.same_picture) json["same_picture"] = *measured.same_picture;
    return json;
}

Json comparison_json(const BenchGroup& group, const BenchCase& measured, const std::string& metric,
                     const timing::Comparison& comparison) {
    return {{"case", measured.name},
            {"baseline", group.cases.front().name},
            {"stage", metric},
            {"pairs", comparison.pairs},
            {"ratio", comparison.ratio},
            {"low", comparison.interval ? Json(comparison.interval->low) : Json(nullptr)},
            {"high", comparison.interval ? Json(comparison.interval->high) : Json(nullptr)},
            {"verdict", timing::to_string(comparison.verdict)}};
}

}  // namespace

std::optional<timing::Comparison> compare_to_baseline(const BenchGroup& group, const BenchCase& other,
                                                      const std::string& metric) {
    const BenchCase& baseline = group.cases.front();
    if (&other == &baseline || !other.layout.compared) return std::nullopt;
    const auto a = other.samples.find(metric), b = baseline.samples.find(metric);
    if (a == other.samples.end() || b == baseline.samples.end()) return std::nullopt;
    return timing::compare(a->second, b->second);
}

Json bench_json(const BenchResults& results) {
    Json entries = Json::array(), cases = Json::array(), comparisons = Json::array(), skipped = Json::array();
    for (size_t g = 0; g < results.groups.size(); ++g) {
        const BenchGroup& group = results.groups[g];
        for (size_t c = 0; c < group.cases.size(); ++c) {
            const BenchCase& measured = group.cases[c];
            if (!measured.skipped.empty()) {
                skipped.push_back({{"case", measured.name}, {"reason", measured.skipped}});
                continue;
            }
            if (measured.samples.empty()) continue;  // Not yet.
            cases.push_back(case_json(results, group, measured));
            for (const char* metric : kCompared) {
                add_entries(measured, metric, c, g, entries);
                if (const auto comparison = compare_to_baseline(group, measured, metric))
                    comparisons.push_back(comparison_json(group, measured, metric, *comparison));
            }
        }
    }
    return {{"context", context_json(results)},
            {"benchmarks", entries},
            {"gnomon",
             {{"format", 1},
              {"baseline", results.layouts.front().name},
              {"axes", axes_json(results)},
              {"repetitions", results.repetitions},
              {"settings", io::settings_json(results.settings)},
              {"copy_bytes_per_second", results.copy_bytes_per_second},
              {"cases", cases},
              {"comparisons", comparisons},
              {"skipped", skipped}}}};
}

}  // namespace gnomon::cli
