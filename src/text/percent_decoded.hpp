// SPDX-License-Identifier: Apache-2.0
// Percent-encoding of addresses (RFC 3986).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// "%20" is a space. Nothing, where a '%' is not followed by two hexadecimal digits.
std::optional<std::string> percent_decoded(std::string_view text);

}  // namespace gnomon
