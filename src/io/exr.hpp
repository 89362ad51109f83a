// SPDX-License-Identifier: Apache-2.0
// OpenEXR images: any number of float channels and text in the header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <gnomon/render.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace gnomon::io {

struct ExrImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<Channel> channels;                  ///< In the file's order, which is alphabetical.
    std::map<std::string, std::string> attributes;  ///< The text attributes of the header but "type".

    /// The channel of this name, or null.
    const Channel* find(const std::string& name) const;
};

/// Write an image of 32-bit floats with lossless ZIP compression. Same arguments, same bytes. Each channel has width * height
/// values, rows from the top, and a name of its own. Errors: as AtomicFile.
void write_exr(const std::filesystem::path& path, uint32_t width, uint32_t height, std::span<const Channel> channels,
               const std::map<std::string, std::string>& attributes);

/// Read an image of one part, scanlines or tiles; half and integer channels become float.
/// Errors: ErrorKind::input where the file is missing, damaged, or has deep pixels, several parts or subsampled channels, is
/// more than 16384 pixels wide or high, or takes more than 4 GiB. The header is checked before memory is taken.
ExrImage read_exr(const std::filesystem::path& path);

}  // namespace gnomon::io
