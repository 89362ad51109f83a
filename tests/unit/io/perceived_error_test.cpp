// SPDX-License-Identifier: Apache-2.0
// SSIM, and pictures as they are shown, on small pictures whose answers follow from the paper's formulas by hand. FLIP:
// flip_test.cpp.
#include "io/perceived_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pictures.hpp"

namespace gnomon::test {

using io::ShownPicture;

TEST(Ssim, EqualPicturesAreOne) {
    const ShownPicture p = picture(30, 30, [](uint32_t x, uint32_t y) { return Color{x / 29.0, y / 29.0, (x ^ y) / 31.0}; });
    EXPECT_NEAR(io::ssim(p, p), 1.0, 1e-12);
}

// Plain pictures vary nowhere: (2 m n + C1) / (m^2 + n^2 + C1). Black and white: C1 / (1 + C1).
TEST(Ssim, PlainPictures) {
    EXPECT_NEAR(io::ssim(plain(kBlack), plain(kWhite)), 1e-4 / 1.0001, 1e-9);
    // Linear 0.2140411 is sRGB 0.5.
    EXPECT_NEAR(io::ssim(plain({0.21404114, 0.21404114, 0.21404114}), plain(kWhite)), 1.0001 / 1.2501, 1e-6);
}

// A checkerboard against its negative: means are alike, the covariance is minus the variance. In the smallest picture with one
// window, 3x3, weights along an axis are g, 1, g over 1 + 2 g with g = exp(-1 / 4.5).
TEST(Ssim, OppositePatterns) {
    const auto board = [](uint32_t first) {
        return picture(3, 3, [=](uint32_t x, uint32_t y) { return (x + y + first) % 2 == 0 ? kWhite : kBlack; });
    };
    const double g = std::exp(-1.0 / 4.5), outer = g / (1.0 + 2.0 * g), inner = 1.0 - 2.0 * outer;
    const double mean = inner * inner + 4.0 * outer * outer, other = 1.0 - mean;  // Middle and corners, against the sides.
    const double variance = mean * other;
    const double expected = (2.0 * mean * other + 1e-4) * (-2.0 * variance + 9e-4) /
                            ((mean * mean + other * other + 1e-4) * (2.0 * variance + 9e-4));
    EXPECT_NEAR(io::ssim(board(0), board(1)), expected, 1e-12);
}

TEST(ShownPicture, IsExposedAndClamped) {
    const std::vector<Channel> channels = {{"R", {0.25f, 2.0f}}, {"B", {-1.0f, 0.5f}}, {"G", {NAN, 0.1f}}};
    const auto shown = io::shown_picture(channels, 2, 1, 1.0);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->rgb[0], (std::vector<double>{0.5, 1.0}));
    EXPECT_EQ(shown->rgb[1][0], 0.0);
    EXPECT_NEAR(shown->rgb[1][1], 0.2, 1e-7);
    EXPECT_EQ(shown->rgb[2], (std::vector<double>{0.0, 1.0}));
    EXPECT_FALSE(io::shown_picture(std::vector<Channel>{{"R", {0.0f}}}, 1, 1, 0.0));
}

}  // namespace gnomon::test
