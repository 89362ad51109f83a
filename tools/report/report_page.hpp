// SPDX-License-Identifier: Apache-2.0
// What was measured of layouts, as a page to read.
#pragma once

#include <string>
#include <vector>

#include "report/bench_file.hpp"
#include "report/data_table.hpp"
#include "report/figures.hpp"

namespace gnomon::report {

/// What is told together.
struct Section {
    std::string id = {};
    std::string title = {};
    std::string note = {};  ///< Text before the figures; empty: none.
    std::vector<Figure> figures = {};
    std::vector<DataTable> tables = {};
    std::string nothing = {};  ///< Why there is neither, where there is neither.
};

/// In the order of the page.
std::vector<Section> sections_of(const std::vector<BenchFile>& files);

/// The whole page: it needs no other file and no network.
std::string to_html(const std::vector<BenchFile>& files, const std::vector<Section>& sections);

}  // namespace gnomon::report
