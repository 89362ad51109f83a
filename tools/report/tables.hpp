// SPDX-License-Identifier: Apache-2.0
// The tables of a report.
#pragma once

#include <vector>

#include "report/bench_file.hpp"
#include "report/data_table.hpp"

namespace gnomon::report {

/// Of each layout, over all scenes and axes: the geometric mean of its ratios and how many verdicts of each kind.
DataTable summary_table(const std::vector<BenchFile>& files);

/// Each comparison of this stage with the baseline: ratio, interval, verdict.
DataTable verdict_table(const std::vector<BenchFile>& files, const std::string& stage);

/// The stages that were compared: query, build and frame first.
std::vector<std::string> compared_stages(const std::vector<BenchFile>& files);

/// Medians, and the quartiles of the query, of each case.
DataTable times_table(const std::vector<BenchFile>& files);

/// What was counted of each case.
DataTable counts_table(const std::vector<BenchFile>& files);

/// Bytes, and whether the case is on the Pareto front of its setting.
DataTable front_table(const std::vector<BenchFile>& files);

/// Of several files, the query's median of what two or more have measured, side by side.
DataTable files_table(const std::vector<BenchFile>& files);

DataTable skipped_table(const std::vector<BenchFile>& files);

/// All that have rows.
std::vector<DataTable> all_tables(const std::vector<BenchFile>& files);

}  // namespace gnomon::report
