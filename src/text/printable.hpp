// SPDX-License-Identifier: Apache-2.0
// What a terminal may be shown.
#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// The text as one line that a terminal only shows: control characters, those that end a line or turn its direction, and bytes
/// that are not UTF-8 are written as \n, \t or \x1b. Names in files that others made may hold them.
std::string printable(std::string_view text);

}  // namespace gnomon
