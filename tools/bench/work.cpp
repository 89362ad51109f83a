// SPDX-License-Identifier: Apache-2.0
// How much work a frame was, from its counts, and what that work would cost at best.
#include "bench/work.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <gnomon/error.hpp>

#include "shared/params.h"

namespace gnomon::bench {
namespace {

uint64_t count(const Frame& frame, const std::string& name) {
    const auto it = frame.stats.counts.find(name);
    if (it != frame.stats.counts.end()) return it->second;
    throw Error(ErrorKind::internal, "a frame without the count " + name, "frame_bench", "report this");
}

uint64_t sum_over_lights(const Frame& frame, const std::string& prefix) {
    uint64_t sum = 0;
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        const auto it = frame.stats.counts.find(prefix + std::to_string(light));
        if (it != frame.stats.counts.end()) sum += it->second;
    }
    return sum;
}

std::optional<double> ratio(double numerator, double denominator) {
    return denominator > 0.0 ? std::optional(numerator / denominator) : std::nullopt;
}

}  // namespace

double seconds_of(const std::vector<FrameStats::Stage>& stages, const std::vector<std::string>& names) {
    double sum = 0.0;
    for (const FrameStats::Stage& stage : stages) {
        if (std::find(names.begin(), names.end(), stage.name) != names.end()) sum += stage.seconds;
    }
    return sum;
}

Work work_of(const Frame& counted, const std::vector<FrameStats::Stage>& stages, uint32_t threads) {
    const double trace_seconds = seconds_of(stages, {"sample/trace"});
    const double raster_seconds = seconds_of(stages, {"raster/count", "raster/fill"});
    const auto samples = static_cast<double>(count(counted, "samples"));
    const auto shadow_tests = static_cast<double>(count(counted, "shadow_tests"));

    Work work;
    work.light_entries = sum_over_lights(counted, "bin_entries.");
    work.ranges = sum_over_lights(counted, "ranges.");
    work.traced_tests = static_cast<double>(count(counted, "camera_tests"));
    work.tests_per_sample = work.traced_tests / samples;
    work.ranges_per_second = ratio(static_cast<double>(work.ranges), raster_seconds);
    work.visited_per_shadow_test = ratio(static_cast<double>(count(counted, "ranges_visited")), shadow_tests);
    work.tested_per_shadow_test = ratio(static_cast<double>(count(counted, "ranges_tested")), shadow_tests);
    if (threads > 0) {
        work.core_ns_per_8_tests = ratio(trace_seconds * 1e9 * threads, work.traced_tests / 8.0);
        work.trace_yardstick_seconds = work.traced_tests / 8.0 * kTraceYardstickNs * 1e-9 / threads;
        work.raster_yardstick_seconds =
            static_cast<double>(work.light_entries) * shared::kTileTexels / 8.0 * kRasterYardstickNs * 1e-9 / threads;
    }
    return work;
}

PictureErrors errors_of(const Frame& frame, const Frame& reference) {
    assert(frame.channels.size() == reference.channels.size());
    double colour[2] = {}, visibility[2] = {};  // Difference, whole.
    for (size_t c = 0; c < frame.channels.size(); ++c) {
        const std::string& name = reference.channels[c].name;
        const bool of_colour = name == "R" || name == "G" || name == "B";
        if (!of_colour && !name.starts_with("visibility.")) continue;
        double(&sums)[2] = of_colour ? colour : visibility;
        const std::vector<float>&got = frame.channels[c].values, &expected = reference.channels[c].values;
        for (size_t i = 0; i < expected.size(); ++i) {
            sums[0] += std::abs(double{got[i]} - expected[i]);
            sums[1] += expected[i];
        }
    }
    return {ratio(colour[0], colour[1]).value_or(0.0), ratio(visibility[0], visibility[1]).value_or(0.0)};
}

Agreement agreement_of(const Frame& frame, const Frame& reference) {
    assert(frame.samples.size() == reference.samples.size() && frame.light_count == reference.light_count);
    Agreement result;
    result.samples = frame.samples.size();
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        const SampleRecord& a = frame.samples[i];
        const SampleRecord& b = reference.samples[i];
        if (a.triangle != b.triangle) continue;
        ++result.hits_agree;
        if (a.triangle == SampleRecord::kMiss) continue;
        result.shadow_tests += frame.light_count;
        for (uint32_t light = 0; light < frame.light_count; ++light)
            result.shadows_agree += frame.lit(i, light) == reference.lit(i, light) ? 1 : 0;
    }
    return result;
}

}  // namespace gnomon::bench
