// SPDX-License-Identifier: Apache-2.0
#include "layouts/sources.hpp"

#include <algorithm>

#include "source_table.h"

namespace gnomon {

std::optional<std::string_view> find_source(std::string_view name) {
    const auto named = [&](const EmbeddedFile& file) { return file.name == name; };
    const auto found = std::find_if(std::begin(kSourceTable), std::end(kSourceTable), named);
    return found == std::end(kSourceTable) ? std::nullopt : std::optional(found->text);
}

}  // namespace gnomon
