// SPDX-License-Identifier: Apache-2.0
// The rows of a benchmark as JSON and as Markdown.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/measure.hpp"

namespace gnomon::bench {

using Json = nlohmann::ordered_json;

/// What all rows share.
struct Context {
    DeviceDescription device;
    Settings settings;  ///< All but spp.
    double scale = 1.0;
};

/// The layout of Google Benchmark's JSON, so that its tools can compare two files:
///   context     date (UTC), num_cpus, cpu, load_avg, library_build_type, device, device_type, driver,
///               versions {gnomon, embree, compiler}, width, height, shadow_res, threads, repetitions, scale
///   benchmarks  for each row one entry of gnomon and one of the reference:
///     name "frame/SCENE/spp:N/PROGRAM", scene, spp, program, threads, repetitions, iterations,
///     real_time, cpu_time, time_unit       medians of wall seconds and of the process's CPU seconds
///     wall_seconds, cpu_seconds            {median, min, max, runs}
///     busy_share                           CPU seconds over wall seconds times threads
///     stages                               [{name, seconds, dispatches}], medians
///     rest_seconds                         {median, min, max, runs}, wall seconds that lie in no stage
///     counts                               {name: number}
///   of gnomon also effective {name: string}, buffers {name: bytes}, peak_bytes, embree_over_gnomon {median, min, max, runs}
///     of wall seconds, embree_over_gnomon_cpu of CPU seconds,
///     work (the members of bench::Work; null: not known), agreement {samples, hits, shadow_tests, shadows}, hits and shadows
///     being shares;
///   of the reference also segments and trials [{segments, wall_seconds}].
Json to_json(const Context& context, const std::vector<Row>& rows);

/// Tables: times, work, stages of either program, yardsticks, largest buffers.
std::string to_markdown(const Context& context, const std::vector<Row>& rows);

}  // namespace gnomon::bench
