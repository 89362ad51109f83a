// SPDX-License-Identifier: Apache-2.0
// Images inside a glTF file: PNG and base64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::makers {

/// An 8-bit RGB PNG, stored without compression. `rgb` has 3 * width * height bytes, the top row first, at most 65,000 with
/// one more per row.
std::vector<uint8_t> encode_png(uint32_t width, uint32_t height, std::span<const uint8_t> rgb);

/// "data:image/png;base64,..."
std::string png_data_uri(std::span<const uint8_t> png);

}  // namespace gnomon::makers
