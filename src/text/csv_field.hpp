// SPDX-License-Identifier: Apache-2.0
// Values separated by commas.
#pragma once

#include <string>

namespace gnomon {

/// The text as a field: within quotes where it needs them (RFC 4180).
std::string csv_field(const std::string& text);

}  // namespace gnomon
