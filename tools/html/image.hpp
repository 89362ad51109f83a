// SPDX-License-Identifier: Apache-2.0
// Images that HTML and SVG can hold.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace gnomon::html {

/// A data: address of a PNG; rgb as io::write_png's.
std::string png_address(uint32_t width, uint32_t height, std::span<const uint8_t> rgb);

}  // namespace gnomon::html
