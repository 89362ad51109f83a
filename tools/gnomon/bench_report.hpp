// SPDX-License-Identifier: Apache-2.0
// What `gnomon bench` writes of its results.
#pragma once

#include "bench_case.hpp"
#include "io/report.hpp"
#include "timing/comparison.hpp"

namespace gnomon::cli {

/// A case against the group's baseline, in one of kCompared. None where either has no samples, and of what is not compared.
std::optional<timing::Comparison> compare_to_baseline(const BenchGroup& group, const BenchCase& other,
                                                      const std::string& metric);

/// Google Benchmark's document, with "gnomon" as a member more: docs/bench.md says what is in it.
io::Json bench_json(const BenchResults& results);

/// "scene,layout,again,<axes>,metric,repetition,milliseconds", a line for each sample.
std::string bench_csv(const BenchResults& results);

/// A table of a group for people, printed.
void print_group(const BenchResults& results, const BenchGroup& group);

}  // namespace gnomon::cli
