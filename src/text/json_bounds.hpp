// SPDX-License-Identifier: Apache-2.0
// Bounds on what a small file can make parsers allocate, and on how deep what walks a document has to go.
#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// That `text` is JSON of at most 64 levels, 500,000 objects and 8,000,000 values, far above what gnomon's inputs hold. `where`
/// and `hint` are those of the error. Errors: ErrorKind::input.
void check_json(std::string_view text, const std::string& where, const std::string& hint);

}  // namespace gnomon
