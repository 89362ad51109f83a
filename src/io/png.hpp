// SPDX-License-Identifier: Apache-2.0
// PNG images, and the tone mapping that makes 8 bits from linear light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <gnomon/render.hpp>
#include <span>
#include <vector>

namespace gnomon::io {

/// The sRGB transfer function (IEC 61966-2-1) of values in [0, 1].
double srgb_encoded(double linear);

/// The same, rounded to 8 bits. Below 0 and NaN give 0, above 1 gives 255.
uint8_t srgb8(double linear);

/// Channels R, G and B times 2^exposure_ev as 8-bit sRGB, 3 bytes per pixel. Premultiplied colour is over black as it is.
/// Errors: ErrorKind::input where R, G or B is missing.
std::vector<uint8_t> tone_map(std::span<const Channel> channels, double exposure_ev);

/// An opaque sRGB image as the bytes of a PNG file; `rgb` has width * height * 3 bytes, rows from the top.
std::vector<std::byte> encode_png(uint32_t width, uint32_t height, std::span<const uint8_t> rgb);

/// Write an opaque sRGB image; `rgb` has width * height * 3 bytes, rows from the top. Same arguments, same bytes.
/// Errors: as AtomicFile.
void write_png(const std::filesystem::path& path, uint32_t width, uint32_t height, std::span<const uint8_t> rgb);

}  // namespace gnomon::io
