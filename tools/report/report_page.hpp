// SPDX-License-Identifier: Apache-2.0
// What was measured of layouts, as a page to read.
#pragma once

#include <string>
#include <vector>

#include "report/bench_file.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {

/// Figures of one kind, one for each setting.
struct FigureGroup {
    std::string title;  ///< Empty: the section has no other.
    std::vector<Figure> figures;
    bool is_folded = false;  ///< Else the first are open.
};

/// What is told together.
struct Section {
    std::string id = {};
    std::string title = {};
    std::string note = {};  ///< Text before the figures; empty: none.
    std::vector<FigureGroup> groups = {};
    std::vector<DataTable> tables = {};
    std::string nothing = {};  ///< Why there is neither, where there is neither.
};

/// In the order of the page.
std::vector<Section> sections_of(const std::vector<BenchFile>& files);

/// The whole page: it needs no other file and no network.
std::string to_html(const std::vector<BenchFile>& files, const std::vector<Section>& sections);

}  // namespace gnomon::report
