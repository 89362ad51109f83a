// SPDX-License-Identifier: Apache-2.0
// What `gnomon bench --json` has written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "timing/comparison.hpp"

namespace gnomon::report {

/// Milliseconds over the repetitions.
struct Times {
    double median = 0.0;
    double q1 = 0.0;
    double q3 = 0.0;
    double least = 0.0;
    size_t samples = 0;
};

/// So many lists have `from` to `to` ranges.
struct Lengths {
    uint64_t from = 0;
    uint64_t to = 0;
    uint64_t lists = 0;

    bool operator==(const Lengths&) const = default;
};

/// Ranges per texel, rows from the top.
struct Texels {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> ranges;

    bool operator==(const Texels&) const = default;
};

/// A layout on a scene, at one value of each axis.
struct Case {
    std::string name;
    std::string scene;
    std::string layout;
    bool lossless = true;
    bool again = false;                                  ///< The A/A row: the baseline a second time.
    std::vector<std::string> values;                     ///< Of each of BenchFile::axes, in their order.
    std::map<std::string, Times> stages;                 ///< "query" is always there.
    std::vector<std::pair<std::string, double>> counts;  ///< What was counted, in the file's order.
    std::vector<Lengths> lengths;                        ///< Empty: not counted.
    std::optional<Texels> texels;                        ///< None: not counted.
    std::optional<bool> same_picture;                    ///< As the baseline's, bit for bit. None: not compared.
    std::optional<double> copy_ms;                       ///< To copy as many bytes as the map has.

    std::string row_name() const { return again ? layout + ", again" : layout; }
    std::optional<double> count(const std::string& of) const;
    const Times* stage(const std::string& of) const;  ///< nullptr: not measured.
};

struct Axis {
    std::string name;
    std::vector<std::string> values;
};

using timing::Verdict;

/// The times of a stage over those of the baseline.
struct Comparison {
    size_t of = 0;  ///< Which of BenchFile::cases.
    std::string baseline;
    std::string stage;
    uint64_t pairs = 0;
    double ratio = 1.0;
    std::optional<double> low, high;  ///< None: the pairs are too few for an interval.
    Verdict verdict = Verdict::undecided;
};

struct Skipped {
    std::string name;
    std::string reason;
};

struct BenchFile {
    std::string path;
    std::string label;                                         ///< What tells it from the other files, on pages.
    std::vector<std::pair<std::string, std::string>> context;  ///< Device, driver, date, ...: name and value.
    std::string device;                                        ///< Empty where it is not said.
    std::string command;                                       ///< Empty where it is not said.
    std::string baseline;
    std::vector<Axis> axes;  ///< All but layouts and scenes.
    std::vector<Case> cases;
    std::vector<Comparison> comparisons;
    std::vector<Skipped> skipped;
};

/// Text is as printable() makes it. Errors: ErrorKind::input, with the file, what is missing or wrong and where in it: no such
/// file, not JSON, not such a document, numbers that are not finite, more cases, texels or longer names than a bench writes.
BenchFile read_bench_file(const std::filesystem::path& path);

/// Labels by which the files are told apart: their devices where no two have the same, else their names.
void label_files(std::vector<BenchFile>& files);

}  // namespace gnomon::report
