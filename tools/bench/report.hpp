// SPDX-License-Identifier: Apache-2.0
// The rows of a benchmark as JSON, Markdown and CSV.
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
    Settings settings;  ///< Of the default scenes, all but spp.
    double scale = 1.0;
};

/// The layout of Google Benchmark's JSON, so that its tools can compare two files:
///   context     date (UTC), num_cpus, cpu, load_avg, library_build_type, device, device_type, driver,
///               versions {gnomon, embree, compiler}, width, height, shadow_res, threads, repetitions, scale
///   benchmarks  for each row one entry of gnomon and one of Embree:
///     name "frame/SCENE/spp:N/PROGRAM", scene, group, value (null: on no growth curve), spp, width, height,
///     shadow_res, program, threads, repetitions, iterations,
///     real_time, cpu_time, time_unit       medians of wall seconds and of the process's CPU seconds
///     wall_seconds, cpu_seconds            {median, min, max, runs}
///     busy_share                           CPU seconds over wall seconds times threads
///     stages                               [{name, seconds, dispatches}], medians
///     rest_seconds                         {median, min, max, runs}, wall seconds that lie in no stage
///     counts                               {name: number}
///   of gnomon also effective {name: string}, buffers {name: bytes}, peak_bytes, embree_over_gnomon {median, min, max, runs}
///     of wall seconds, embree_over_gnomon_cpu of CPU seconds, work (the members of bench::Work; null: not known), agreement
///     {samples, hits, shadow_tests, shadows}, hits and shadows being shares;
///   of Embree also peer, the variant {segments, quality, calls, order}, trials [{the same members, whole, wall_seconds,
///     cpu_seconds}], and picture_errors {colour, visibility}, see bench::PictureErrors.
///   gnomon's entry of a frame that did not fit into memory has, of numbers, none, but error_occurred and error_message.
Json to_json(const Context& context, const std::vector<Row>& rows);

/// Tables: times, growth curves, work, stages of either program, yardsticks, largest buffers.
std::string to_markdown(const Context& context, const std::vector<Row>& rows);

/// A line of medians for each row, below a line of names. What gnomon did not do is empty.
std::string to_csv(const std::vector<Row>& rows);

/// Where a row of a growth curve lies on it: really, not at full scale.
double growth_value(const Row& row);

}  // namespace gnomon::bench
