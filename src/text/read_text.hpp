// SPDX-License-Identifier: Apache-2.0
// Text files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gnomon {

/// The content of a regular file of at most 64 MiB; nothing, and a reason, where it is none or cannot be read. Anything else
/// under that name, as a pipe, is not waited for.
std::optional<std::string> read_text(const std::filesystem::path& path, std::string& reason);

}  // namespace gnomon
