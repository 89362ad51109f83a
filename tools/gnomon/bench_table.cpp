// SPDX-License-Identifier: Apache-2.0
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "bench_report.hpp"
#include "command.hpp"
#include "timing/summary.hpp"

namespace gnomon::cli {

namespace {

std::string milliseconds(double value) { return fmt::format("{:.{}f}", value, value < 10.0 ? 3 : value < 100.0 ? 2 : 1); }

std::string count_text(const BenchCase& measured, const std::string& name) {
    const auto found = measured.counts.find(name);
    return found == measured.counts.end() ? "-" : fmt::format("{:.0f}", found->second);
}

std::string interval_text(const timing::Comparison& comparison) {
    return comparison.interval ? fmt::format("{:.3f} to {:.3f}", comparison.interval->low, comparison.interval->high) : "-";
}

void print_metric(const BenchGroup& group, const BenchCase& measured, const std::string& metric, bool first) {
    const timing::Summary summary = timing::summarize(measured.samples.at(metric));
    std::string line =
        fmt::format("{:<20} {:<6} {:>9} {:>19}", first ? measured.layout.name + (measured.layout.again ? " (again)" : "") : "",
                    metric, milliseconds(summary.median), milliseconds(summary.q1) + " to " + milliseconds(summary.q3));
    const auto comparison = compare_to_baseline(group, measured, metric);
    line += comparison ? fmt::format(" {:>8.3f} {:>16}  {:<9}", comparison->ratio, interval_text(*comparison),
                                     timing::to_string(comparison->verdict))
                       : fmt::format(" {:>8} {:>16}  {:<9}", "-", "-", "-");
    if (first) line += fmt::format(" {:>12} {:>10}", count_text(measured, "map_bytes"), count_text(measured, "lost"));
    line.erase(line.find_last_not_of(' ') + 1);
    print_line(line);
}

/// A column of what was counted.
struct CountColumn {
    const char* title;
    const char* member;
};
constexpr CountColumn kCountColumns[] = {{"ranges", "ranges_visited_per_query"},
                                         {"tests", "triangles_tested_per_query"},
                                         {"reads", "reads_per_query"},
                                         {"chain", "chain_per_query"},
                                         {"bytes", "bytes_per_query"},
                                         {"sectors", "sectors_per_query"},
                                         {"useful", "useful_share"},
                                         {"lanes", "lane_activity"},
                                         {"atomics", "atomics"},
                                         {"on one", "most_atomics_on_one"},
                                         {"used", "used_bytes"}};

/// Four digits, without an exponent.
std::string figure(double value) {
    const int decimals = value >= 999.5 || value == std::floor(value) ? 0 : value >= 99.95 ? 1 : value >= 9.995 ? 2 : 3;
    return fmt::format("{:.{}f}", value, decimals);
}

void print_counts(const BenchGroup& group) {
    std::string line = fmt::format("{:<20}", "a query, or in all");
    for (const CountColumn& column : kCountColumns) line += fmt::format(" {:>9}", column.title);
    print_line(line);
    for (const BenchCase& measured : group.cases) {
        if (!measured.skipped.empty() || measured.layout.again) continue;
        line = fmt::format("{:<20}", measured.layout.name);
        for (const CountColumn& column : kCountColumns) {
            const auto found = measured.counts.find(column.member);
            line += fmt::format(" {:>9}", found == measured.counts.end() ? "-" : figure(found->second));
        }
        print_line(line);
    }
}

}  // namespace

void print_group(const BenchResults& results, const BenchGroup& group) {
    print_line(fmt::format("{}: {} repetitions on {}", group.text(), results.repetitions, results.device.name));
    print_line(fmt::format("{:<20} {:<6} {:>9} {:>19} {:>8} {:>16}  {:<9} {:>12} {:>10}", "layout", "", "median ms",
                           "quartiles", "ratio", "95 % interval", "verdict", "map bytes", "lost"));
    for (const BenchCase& measured : group.cases) {
        if (!measured.skipped.empty()) {
            print_line(fmt::format("{:<20} left out: {}", measured.layout.name, measured.skipped));
            continue;
        }
        bool first = true;
        for (const char* metric : kCompared) {
            if (!measured.samples.contains(metric)) continue;
            print_metric(group, measured, metric, first);
            first = false;
        }
    }
    print_counts(group);
    print_line("");
}

}  // namespace gnomon::cli
