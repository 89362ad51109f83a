// SPDX-License-Identifier: Apache-2.0
// Images inside a glTF file.
// Based on: PNG specification (ISO/IEC 15948), RFC 1950 (zlib), RFC 1951 (stored blocks), RFC 4648 (base64).
#include "png.hpp"

#include <cassert>
#include <string_view>

namespace gnomon::makers {
namespace {

void put_u32(std::vector<uint8_t>& to, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<uint8_t>(value >> shift));
}

uint32_t crc32(std::span<const uint8_t> bytes) {
    uint32_t crc = 0xffffffffu;
    for (const uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

uint32_t adler32(std::span<const uint8_t> bytes) {
    uint32_t a = 1, b = 0;
    for (const uint8_t byte : bytes) {
        a = (a + byte) % 65521u;
        b = (b + a) % 65521u;
    }
    return b << 16 | a;
}

void put_chunk(std::vector<uint8_t>& png, std::string_view type, const std::vector<uint8_t>& data) {
    put_u32(png, static_cast<uint32_t>(data.size()));
    const std::size_t start = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    put_u32(png, crc32(std::span(png).subspan(start)));
}

}  // namespace

std::vector<uint8_t> encode_png(uint32_t width, uint32_t height, std::span<const uint8_t> rgb) {
    assert(rgb.size() == std::size_t{3} * width * height);
    std::vector<uint8_t> rows;
    for (uint32_t y = 0; y < height; ++y) {
        rows.push_back(0);  // No filter.
        const auto row = rgb.subspan(std::size_t{3} * width * y, std::size_t{3} * width);
        rows.insert(rows.end(), row.begin(), row.end());
    }
    assert(rows.size() <= 0xffffu);  // One stored block.

    std::vector<uint8_t> header;
    put_u32(header, width);
    put_u32(header, height);
    header.insert(header.end(), {8, 2, 0, 0, 0});  // 8 bits, RGB, deflate, adaptive filters, not interlaced.

    const auto size = static_cast<uint16_t>(rows.size());
    const auto inverse = static_cast<uint16_t>(~size);
    std::vector<uint8_t> data = {0x78, 0x01, 0x01};  // zlib, 32 KiB window; the last block, stored.
    for (const uint16_t value : {size, inverse}) {
        data.push_back(static_cast<uint8_t>(value & 0xffu));
        data.push_back(static_cast<uint8_t>(value >> 8));
    }
    data.insert(data.end(), rows.begin(), rows.end());
    put_u32(data, adler32(rows));

    std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    put_chunk(png, "IHDR", header);
    put_chunk(png, "IDAT", data);
    put_chunk(png, "IEND", {});
    return png;
}

std::string png_data_uri(std::span<const uint8_t> png) {
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string uri = "data:image/png;base64,";
    for (std::size_t i = 0; i < png.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, png.size() - i);
        uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? png[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) uri.push_back(k <= count ? kDigits[bits >> (18 - 6 * k) & 63u] : '=');
    }
    return uri;
}

}  // namespace gnomon::makers
