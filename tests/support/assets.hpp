// SPDX-License-Identifier: Apache-2.0
// The folder of models that tests use where it is there; it is no part of the source tree.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/paths.hpp"

namespace gnomon::test {

/// The environment's GNOMON_ASSETS, else the folder beside the source tree. May not exist.
inline std::filesystem::path assets_folder() {
    const char* folder = std::getenv("GNOMON_ASSETS");
    return folder != nullptr ? std::filesystem::path(folder)
                             : std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "../shared/assets";
}

/// Skips the test, loudly, where there is no such folder.
#define GN_SKIP_WITHOUT_ASSETS()                                                                            \
    if (!std::filesystem::is_directory(gnomon::test::assets_folder())) {                                    \
        GTEST_SKIP() << "skipped: no assets folder (set GNOMON_ASSETS): " << gnomon::test::assets_folder(); \
    }

/// A tab-separated table: each row by the names of the columns.
inline std::vector<std::map<std::string, std::string>> read_table(const std::filesystem::path& path) {
    const auto cells = [](const std::string& line) {
        std::vector<std::string> result;
        std::stringstream stream(line);
        for (std::string cell; std::getline(stream, cell, '\t');) result.push_back(cell);
        return result;
    };
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> names = cells(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(file, line)) {
        const std::vector<std::string> values = cells(line);
        std::map<std::string, std::string> row;
        for (size_t i = 0; i < names.size(); ++i) row[names[i]] = i < values.size() ? values[i] : "";
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace gnomon::test
