// SPDX-License-Identifier: Apache-2.0
// Files that the build has made into text.
#pragma once

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>
#include <string_view>

namespace gnomon::html {

/// The file of this name in a table that gnomon_embed_files has made. It has to be there.
template <class Table>
std::string embedded(const Table& table, std::string_view name) {
    const auto found = std::find_if(std::begin(table), std::end(table), [&](const auto& file) { return file.name == name; });
    assert(found != std::end(table));
    return std::string(found->text);
}

}  // namespace gnomon::html
