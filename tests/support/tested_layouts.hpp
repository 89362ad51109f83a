// SPDX-License-Identifier: Apache-2.0
// Which layouts a test that goes over all of them goes over.
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "layouts/layout.hpp"

namespace gnomon::test {

/// Those that GNOMON_TEST_LAYOUTS names, separated by commas; all, if it is not set.
inline std::vector<std::string> tested_layouts() {
    const char* names = std::getenv("GNOMON_TEST_LAYOUTS");
    if (names == nullptr) return layout_names();
    std::vector<std::string> result;
    std::istringstream text(names);
    for (std::string name; std::getline(text, name, ',');) result.push_back(find_layout(name).name);
    return result;
}

}  // namespace gnomon::test
