// SPDX-License-Identifier: Apache-2.0
// Images that HTML and SVG can hold.
#include "html/image.hpp"

#include <cstddef>
#include <string_view>

#include "io/png.hpp"

namespace gnomon::html {
namespace {

std::string base64(std::span<const std::byte> data) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((data.size() + 2) / 3 * 4);
    for (size_t i = 0; i < data.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < data.size() ? std::to_integer<uint32_t>(data[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) text += i + k > data.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63u];
    }
    return text;
}

}  // namespace

std::string png_address(uint32_t width, uint32_t height, std::span<const uint8_t> rgb) {
    return "data:image/png;base64," + base64(io::encode_png(width, height, rgb));
}

}  // namespace gnomon::html
