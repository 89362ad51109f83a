// SPDX-License-Identifier: Apache-2.0
// PNG images, and the tone mapping that makes 8 bits from linear light.
#include "io/png.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <gnomon/error.hpp>

#include "io/atomic_file.hpp"

namespace gnomon::io {

double srgb_encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

uint8_t srgb8(double linear) {
    if (!(linear > 0.0)) return 0;
    if (linear >= 1.0) return 255;
    return static_cast<uint8_t>(std::lround(srgb_encoded(linear) * 255.0));
}

std::vector<uint8_t> tone_map(std::span<const Channel> channels, double exposure_ev) {
    constexpr std::array kNames = {"R", "G", "B"};
    const double scale = std::exp2(exposure_ev);
    std::vector<uint8_t> rgb;
    for (size_t i = 0; i < kNames.size(); ++i) {
        const auto channel =
            std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == kNames[i]; });
        if (channel == channels.end())
            throw Error(ErrorKind::input, std::string("an image without a channel ") + kNames[i] + " cannot be a PNG", "",
                        "give an image with the channels R, G and B");
        rgb.resize(channel->values.size() * kNames.size());
        for (size_t pixel = 0; pixel < channel->values.size(); ++pixel)
            rgb[pixel * kNames.size() + i] = srgb8(channel->values[pixel] * scale);
    }
    return rgb;
}

std::vector<std::byte> encode_png(uint32_t width, uint32_t height, std::span<const uint8_t> rgb) {
    assert(rgb.size() == uint64_t{width} * height * 3);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> encoded(bytes);
    if (png_image_write_to_memory(&image, encoded.data(), &bytes, 0, rgb.data(), 0, nullptr) == 0)
        throw Error(ErrorKind::internal, std::string("libpng refused the image: ") + image.message, "", "please report it");
    encoded.resize(bytes);
    return encoded;
}

void write_png(const std::filesystem::path& path, uint32_t width, uint32_t height, std::span<const uint8_t> rgb) {
    AtomicFile file(path);
    file.write(encode_png(width, height, rgb));
    file.commit();
}

}  // namespace gnomon::io
