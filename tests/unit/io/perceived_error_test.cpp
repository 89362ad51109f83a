// SPDX-License-Identifier: Apache-2.0
// FLIP and SSIM on small pictures whose answers follow from the papers' formulas by hand.
#include "io/perceived_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gnomon::test {

using io::ShownPicture;

namespace {

using Color = std::array<double, 3>;

ShownPicture picture(uint32_t width, uint32_t height, const std::function<Color(uint32_t, uint32_t)>& color) {
    ShownPicture result{width, height, {}};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c) result.rgb[c].push_back(color(x, y)[c]);
    return result;
}

ShownPicture plain(const Color& color) {
    return picture(24, 20, [&](uint32_t, uint32_t) { return color; });
}

constexpr Color kBlack = {0, 0, 0}, kWhite = {1, 1, 1}, kGreen = {0, 1, 0}, kBlue = {0, 0, 1};

double largest_of(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double least_of(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

}  // namespace

TEST(Flip, EqualPicturesDoNotDiffer) {
    const ShownPicture p = picture(30, 30, [](uint32_t x, uint32_t y) { return Color{x / 29.0, y / 29.0, (x ^ y) / 31.0}; });
    EXPECT_EQ(largest_of(io::flip(p, p)), 0.0);
}

// Plain pictures have no features, so that the error is that of the colours alone. Green and blue differ most.
TEST(Flip, PlainColors) {
    const std::vector<double> most = io::flip(plain(kGreen), plain(kBlue));
    EXPECT_NEAR(least_of(most), 1.0, 1e-6);
    EXPECT_NEAR(largest_of(most), 1.0, 1e-6);
    // Black and white: 100 of lightness. Green is (87.74, -86.18, 83.18) in CIELAB, blue (32.30, 79.19, -107.86); with a and b
    // times L / 100 they are (87.74, -75.61, 72.98) and (32.30, 25.58, -34.84), 55.44 + 147.98 = 203.4 apart. 0.95 + 0.05
    // (100^0.7 - 0.4 203.4^0.7) / (0.6 203.4^0.7) = 0.9674.
    const std::vector<double> contrast = io::flip(plain(kBlack), plain(kWhite));
    EXPECT_NEAR(least_of(contrast), 0.9674, 5e-4);
    EXPECT_NEAR(largest_of(contrast), 0.9674, 5e-4);
    // Below the knee: 10 of lightness, from 50 to 60. 0.95 / 0.4 (10 / 203.4)^0.7 = 0.2883.
    const auto grey = [](double lightness) {
        const double y = std::pow((lightness + 16.0) / 116.0, 3.0);
        return Color{y, y, y};
    };
    EXPECT_NEAR(largest_of(io::flip(plain(grey(50.0)), plain(grey(60.0)))), 0.2883, 5e-4);
}

// A step that moves by two pixels differs there, and not far from there.
TEST(Flip, EdgesAreSeenWhereTheyAre) {
    const ShownPicture step = picture(64, 8, [](uint32_t x, uint32_t) { return x < 32 ? kBlack : kWhite; });
    const ShownPicture moved = picture(64, 8, [](uint32_t x, uint32_t) { return x < 34 ? kBlack : kWhite; });
    const std::vector<double> error = io::flip(moved, step);
    const size_t row = 4 * 64;
    EXPECT_GT(error[row + 32], 0.5);
    EXPECT_GT(error[row + 33], 0.5);
    EXPECT_LT(error[row + 4], 1e-3);
    EXPECT_LT(error[row + 60], 1e-3);
}

// What only one picture has a line for counts more than its colour alone does.
TEST(Flip, FeaturesAddToColors) {
    const ShownPicture grey = picture(41, 41, [](uint32_t, uint32_t) { return Color{0.4, 0.4, 0.4}; });
    const ShownPicture line = picture(41, 41, [](uint32_t x, uint32_t) {
        return x == 20 ? Color{0.6, 0.6, 0.6} : Color{0.4, 0.4, 0.4};
    });
    const double middle = io::flip(line, grey)[20 * 41 + 20];
    EXPECT_GT(middle, 0.05);
    EXPECT_LT(middle, 0.9);
    EXPECT_NEAR(io::flip(line, grey)[20 * 41 + 20], io::flip(grey, line)[20 * 41 + 20], 1e-12);
    EXPECT_LT(io::flip(line, grey)[20 * 41 + 2], middle / 10.0);
}

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
