// SPDX-License-Identifier: Apache-2.0
// Where in a JSON text a value is, so that complaints about it can say so.
#pragma once

#include <cstddef>
#include <string_view>

namespace gnomon {

/// The line, from 1, on which a value of valid JSON begins; of a member, on which its name is. pointer: "/buffers/2/clear", as
/// of RFC 6901 without escapes. What is missing is where the last of its parents is that is there.
size_t json_line(std::string_view text, std::string_view pointer);

}  // namespace gnomon
