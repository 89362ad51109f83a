// SPDX-License-Identifier: Apache-2.0
// Small pictures to compare.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "io/perceived_error.hpp"

namespace gnomon::test {

using Color = std::array<double, 3>;  ///< Linear R, G, B.

constexpr Color kBlack = {0, 0, 0}, kWhite = {1, 1, 1}, kGreen = {0, 1, 0}, kBlue = {0, 0, 1};

inline io::ShownPicture picture(uint32_t width, uint32_t height, const std::function<Color(uint32_t, uint32_t)>& color) {
    io::ShownPicture result{width, height, {}};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c) result.rgb[c].push_back(color(x, y)[c]);
    return result;
}

inline io::ShownPicture plain(const Color& color) {
    return picture(24, 20, [&](uint32_t, uint32_t) { return color; });
}

}  // namespace gnomon::test
