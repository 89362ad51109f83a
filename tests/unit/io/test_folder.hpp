// SPDX-License-Identifier: Apache-2.0
// A folder of its own for each test, and what the tests ask of files.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace gnomon::test {

inline std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_content(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
}

/// Empty at the start of a test, gone after it.
class TestFolder : public ::testing::Test {
protected:
    TestFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon_test_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + name);
        folder = name;
    }
    ~TestFolder() override { std::filesystem::remove_all(folder); }

    /// Names of everything in the folder, hidden files included.
    std::set<std::string> names() const {
        std::set<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) found.insert(entry.path().filename().string());
        return found;
    }

    std::filesystem::path folder;
};

}  // namespace gnomon::test
