// SPDX-License-Identifier: Apache-2.0
// Which measurements belong together.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "report/bench_file.hpp"

namespace gnomon::report {

/// A scene at one value of each axis: the cases that differ in the layout alone.
struct Setting {
    const BenchFile* file = nullptr;
    std::string scene;
    std::vector<std::string> values;  ///< Of the file's axes.
    std::vector<const Case*> cases;   ///< As in the file.
    bool is_first = false;            ///< Of its scene.

    /// "random-cubes, shadow-res 256": with those axes of which the file has several values.
    std::string title() const;
};

/// In the order of their first cases.
std::vector<Setting> settings_of(const BenchFile& file);

/// One scene and one value of each axis but one, over the values of that one.
struct Sweep {
    const BenchFile* file = nullptr;
    size_t axis = 0;
    std::string scene;
    std::vector<std::string> values;                          ///< Of the file's axes; that of `axis` does not matter.
    std::map<std::string, std::vector<const Case*>> layouts;  ///< By layout: a case for each value of the axis; nullptr: none.
    bool is_first = false;                                    ///< Of its scene and axis.

    /// As Setting::title, without the axis.
    std::string title() const;
};

/// Of every axis with more than one value, in the order of the axes; no A/A rows. Sweeps with cases at one value only are not
/// among them.
std::vector<Sweep> sweeps_of(const BenchFile& file);

/// Numbers where all values are numbers above 0, which then are in ascending order; else empty.
std::vector<double> numbers_of(const std::vector<std::string>& values);

struct Cost {
    double bytes = 0.0;
    double ms = 0.0;
};

/// Which of them are not beaten: none other takes at most as many of both, and less of one. By bytes.
std::vector<size_t> pareto_front(const std::vector<Cost>& costs);

/// Those of a setting whose bytes are known, without the A/A row.
std::vector<const Case*> cases_with_bytes(const Setting& setting);

/// Of these the Pareto front of bytes and query time, among those that answer all.
std::set<const Case*> front_of(const std::vector<const Case*>& cases);

/// The layouts of all files in the order of their first cases: their numbers are their colours on a page.
std::vector<std::string> layouts_of(const std::vector<BenchFile>& files);

/// The layout that keeps no ranges: what no layout can be faster than.
inline constexpr const char* kNullLayout = "null";

/// Its answers are not those of the others: it keeps no ranges (null), has lost some, or its picture is another.
bool answers_less(const Case& c);

}  // namespace gnomon::report
