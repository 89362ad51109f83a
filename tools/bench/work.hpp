// SPDX-License-Identifier: Apache-2.0
// How much work a frame was, from its counts, and what that work would cost at best.
#pragma once

#include <cstdint>
#include <gnomon/render.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::bench {

/// Per unit of work, from a frame with RenderSettings::count_ranges. What cannot be known is empty: what divides by a count of
/// 0, and core times of a device that is not a CPU.
struct Work {
    uint64_t light_entries = 0;  ///< Of the bins of all lights.
    uint64_t ranges = 0;         ///< Of all lights.

    /// Sum over the camera's lists of entries times the samples that need the list, over all samples.
    double tests_per_sample = 0.0;
    /// Sample-triangle tests that sample/trace runs: whole tiles, and every list that a stratum may need.
    double traced_tests = 0.0;

    std::optional<double> core_ns_per_8_tests;  ///< Seconds of sample/trace times threads.
    std::optional<double> ranges_per_second;    ///< Over the seconds of raster/count and raster/fill.
    std::optional<double> visited_per_shadow_test;
    std::optional<double> tested_per_shadow_test;

    /// Seconds at the yardsticks below, of a CPU's threads.
    std::optional<double> trace_yardstick_seconds;
    std::optional<double> raster_yardstick_seconds;
};

/// Core-nanoseconds for 8 sample-triangle tests: AVX2 with FMA, written by hand.
inline constexpr double kTraceYardstickNs = 13.0;
/// Core-nanoseconds for 8 texel-triangle pairs, counted (67) and filled (133): the best shader in a test of formulations.
inline constexpr double kRasterYardstickNs = 200.0;

/// counted: the frame with its counts. stages: seconds, of the frames without counting. threads: of a CPU device; 0: the device
/// is not a CPU. Errors: ErrorKind::internal for a count that the frame lacks.
Work work_of(const Frame& counted, const std::vector<FrameStats::Stage>& stages, uint32_t threads);

/// Seconds of all stages of these names; 0 where none ran.
double seconds_of(const std::vector<FrameStats::Stage>& stages, const std::vector<std::string>& names);

/// Which part of the samples agree with the reference.
struct Agreement {
    uint64_t samples = 0;
    uint64_t hits_agree = 0;    ///< Samples with the same triangle, or a miss in both.
    uint64_t shadow_tests = 0;  ///< Samples times lights where both hit the same triangle.
    uint64_t shadows_agree = 0;
    double hit_share() const { return samples > 0 ? double(hits_agree) / double(samples) : 1.0; }
    double shadow_share() const { return shadow_tests > 0 ? double(shadows_agree) / double(shadow_tests) : 1.0; }
};

/// What the peer's picture differs by: the mean over pixels of the difference, over the mean. 0 where both are 0.
struct PictureErrors {
    double colour = 0.0;      ///< Of R, G and B together.
    double visibility = 0.0;  ///< Of all lights together.
};

/// Frames of the same scene and size.
PictureErrors errors_of(const Frame& frame, const Frame& reference);

/// Both frames hold the samples of the same settings.
Agreement agreement_of(const Frame& frame, const Frame& reference);

}  // namespace gnomon::bench
