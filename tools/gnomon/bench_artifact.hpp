// SPDX-License-Identifier: Apache-2.0
// The folder of `gnomon bench --artifact`: what somebody needs who repeats a run, or cites it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench_case.hpp"

namespace gnomon::cli {

/// Errors: ErrorKind::input where there is something of that name already, or its folder cannot be written to.
void check_artifact(const std::filesystem::path& folder);

/// Make the folder: results.json, results.csv, run.sh, system.txt, CITATION.cff, README.md, copies of the layouts that came
/// from folders, and of the scenes with the files that they name. It takes its name when all is in it. Errors: as of
/// check_artifact.
void write_artifact(const std::filesystem::path& folder, const BenchResults& results, const std::vector<std::string>& scenes);

}  // namespace gnomon::cli
