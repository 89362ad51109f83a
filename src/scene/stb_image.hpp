// SPDX-License-Identifier: Apache-2.0
// Decoding PNG and JPEG.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::gltf {

struct ImageSize {
    uint32_t width = 0;
    uint32_t height = 0;
};

/// What the header of an image file states; nothing, and a reason, if it is not valid or states more than such a file can hold.
/// Sides are at most 16384.
std::optional<ImageSize> image_size(std::span<const uint8_t> file, std::string& reason);

/// Four bytes per texel, rows from the top; empty, and a reason, if the file is not valid. `size`: what the header states; data
/// that unpack to more are not valid.
std::vector<uint8_t> decode_rgba(std::span<const uint8_t> file, ImageSize size, std::string& reason);

}  // namespace gnomon::gltf
