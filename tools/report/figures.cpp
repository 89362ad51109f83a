// SPDX-License-Identifier: Apache-2.0
// What the figures of a report have in common.
#include "report/figures.hpp"

#include <algorithm>

namespace gnomon::report {
namespace {

// For the names of files, whatever a scene is called.
std::string plain(const std::string& text) {
    constexpr size_t kMost = 100;
    std::string result;
    for (const char c : text) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        const bool is_capital = c >= 'A' && c <= 'Z';
        if (is_plain || is_capital)
            result += is_capital ? static_cast<char>(c - 'A' + 'a') : c;
        else if (!result.empty() && result.back() != '-')
            result += '-';
        if (result.size() == kMost) break;
    }
    return result;
}

}  // namespace

size_t Sources::colour_of(const std::string& layout) const {
    return static_cast<size_t>(std::find(layouts_.begin(), layouts_.end(), layout) - layouts_.begin());
}

std::string Sources::title(const BenchFile& file, const std::string& what) const {
    return files_.size() > 1 ? what + " (" + file.label + ")" : what;
}

std::string Sources::name(const BenchFile& file, const std::string& kind, const std::string& what) const {
    const auto number = static_cast<size_t>(&file - files_.data()) + 1;
    return kind + "-" + plain(what) + (files_.size() > 1 ? "-file-" + std::to_string(number) : "");
}

}  // namespace gnomon::report
