// SPDX-License-Identifier: Apache-2.0
// Means over pixels: standard errors by hand, and against the spread over many seeds.
#include "io/pixel_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace gnomon::test {

using io::pixel_mean;
using io::PixelMean;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr uint32_t kWidth = 96, kHeight = 64;  // Blocks of about 9 pixels along a side: 10 x 8.

/// White noise, one value per pixel.
std::vector<double> noise(std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::vector<double> values(kWidth * kHeight);
    for (double& value : values) value = normal(random);
    return values;
}

struct Spread {
    double mean = 0.0;            ///< Of the means over the pixels.
    double deviation = 0.0;       ///< Of the same.
    double standard_error = 0.0;  ///< As reported: root of the mean square.
};

/// Over the pictures that many seeds give.
Spread spread(const std::function<std::vector<double>(std::mt19937&)>& picture) {
    constexpr int kSeeds = 1000;
    double sum = 0.0, squares = 0.0, variances = 0.0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        std::mt19937 random(static_cast<unsigned>(seed));
        const PixelMean mean = pixel_mean(picture(random), kWidth);
        sum += mean.mean;
        squares += mean.mean * mean.mean;
        variances += mean.standard_error * mean.standard_error;
    }
    const double mean = sum / kSeeds;
    return {mean, std::sqrt((squares / kSeeds - mean * mean) * kSeeds / (kSeeds - 1.0)), std::sqrt(variances / kSeeds)};
}

/// `values` of 16 x 16 pixels, which make 4 x 4 blocks, that are 1 at these (x, y) and else 0: the standard error.
double error_of_ones(const std::vector<std::pair<uint32_t, uint32_t>>& ones) {
    std::vector<double> values(256, 0.0);
    for (const auto& [x, y] : ones) values[y * 16 + x] = 1.0;
    return pixel_mean(values, 16).standard_error;
}

}  // namespace

TEST(PixelMean, WorkedByHand) {
    // Two blocks of one pixel; less the mean they are -1 and 1.
    const PixelMean two = pixel_mean(std::vector<double>{1.0, 3.0}, 2);
    EXPECT_EQ(two.mean, 2.0);
    EXPECT_EQ(two.standard_error, 1.0);
    // Two blocks of two pixels; less the mean, 4, their sums are -5 and 5.
    for (const uint32_t width : {4u, 1u}) {
        const PixelMean four = pixel_mean(std::vector<double>{1.0, 2.0, 5.0, 8.0}, width);
        EXPECT_EQ(four.mean, 4.0);
        EXPECT_EQ(four.standard_error, 2.5);
    }
}

// Of four blocks those on one diagonal count as positive and the others as negative.
TEST(PixelMean, BlocksAreTakenByFour) {
    EXPECT_DOUBLE_EQ(error_of_ones({{5, 5}}), 1.0 / 256.0);
    EXPECT_DOUBLE_EQ(error_of_ones({{4, 4}, {7, 7}}), 2.0 / 256.0);             // In one block.
    EXPECT_DOUBLE_EQ(error_of_ones({{3, 3}, {4, 4}}), 2.0 / 256.0);             // On one diagonal of four.
    EXPECT_DOUBLE_EQ(error_of_ones({{3, 4}, {4, 4}}), 0.0);                     // Side by side.
    EXPECT_DOUBLE_EQ(error_of_ones({{4, 3}, {4, 4}}), 0.0);                     // One above the other.
    EXPECT_DOUBLE_EQ(error_of_ones({{7, 4}, {8, 4}}), std::sqrt(2.0) / 256.0);  // Of different fours.
    EXPECT_DOUBLE_EQ(error_of_ones({{4, 7}, {4, 8}}), std::sqrt(2.0) / 256.0);
}

// Blocks of two pixels and of one, or with pixels left out, differ by their counts times the mean: that is no noise.
TEST(PixelMean, UnequalBlocksOfOneValue) {
    EXPECT_EQ(pixel_mean(std::vector<double>{5.0, 5.0, 5.0}, 3).standard_error, 0.0);
    EXPECT_EQ(pixel_mean(std::vector<double>{5.0, 5.0, 5.0, kNan}, 4).standard_error, 0.0);
}

// What changes along one axis, however steeply, says nothing of noise.
TEST(PixelMean, SlopesAreNotNoise) {
    std::vector<double> values(256);
    for (size_t i = 0; i < values.size(); ++i) values[i] = std::exp(static_cast<double>(i % 16)) + (i / 16 < 5 ? 0.0 : 1.0);
    EXPECT_NEAR(pixel_mean(values, 16).standard_error / pixel_mean(values, 16).mean, 0.0, 1e-12);
}

TEST(PixelMean, NanIsLeftOut) {
    const PixelMean mean = pixel_mean(std::vector<double>{kNan, 1.0, kNan, 3.0}, 4);
    EXPECT_EQ(mean.count, 2u);
    EXPECT_EQ(mean.mean, 2.0);
    EXPECT_EQ(mean.standard_error, 1.0);
    for (const double value : {5.0, kNan}) {
        const PixelMean unsure = pixel_mean(std::vector<double>{kNan, value}, 2);
        EXPECT_EQ(unsure.mean, std::isnan(value) ? 0.0 : 5.0);
        EXPECT_EQ(unsure.count, std::isnan(value) ? 0u : 1u);
        EXPECT_TRUE(std::isnan(unsure.standard_error));
    }
}

// 1000 seeds tell a deviation to 2.2 %, 35 pairs of blocks make the reported one certain to less than that. Each test allows 7
// %.
TEST(PixelMean, SpreadOfIndependentPixels) {
    const Spread s = spread(noise);
    EXPECT_NEAR(s.deviation, 1.0 / std::sqrt(kWidth * kHeight), 0.07 / std::sqrt(kWidth * kHeight));
    EXPECT_NEAR(s.standard_error / s.deviation, 1.0, 0.07);
}

// Noise in a disc, and what is expected goes up and down by far more than the noise does.
TEST(PixelMean, SpreadWithNoiseInPlacesAndASlope) {
    const Spread s = spread([](std::mt19937& random) {
        std::vector<double> values = noise(random);
        for (uint32_t i = 0; i < values.size(); ++i) {
            const double x = i % kWidth / 96.0, y = i / kWidth / 64.0;
            const double scale = std::hypot(x - 0.3, y - 0.5) < 0.2 ? 1.0 : 0.0;
            values[i] = scale * values[i] + std::sin(3.0 * y) + 0.1 * x;
        }
        return values;
    });
    EXPECT_NEAR(s.standard_error / s.deviation, 1.0, 0.07);
}

// Noise that 3 x 3 pixels share: the mean is three times as unsure as that of independent pixels of the same deviation. Blocks
// of about 9 pixels miss what reaches over their borders: along an axis the sum of 9 has 73 of 81 parts of the variance, and
// the difference of two such sums 69 on each side; both axes together leave the standard error 69 / 81 = 0.85 of the spread.
TEST(PixelMean, SpreadOfPixelsThatDependOnTheirNeighbours) {
    const Spread s = spread([](std::mt19937& random) {
        const std::vector<double> white = noise(random);
        std::vector<double> values(white.size(), 0.0);
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x)
                for (uint32_t k = 0; k < 9; ++k)
                    values[y * kWidth + x] += white[(y + k / 3) % kHeight * kWidth + (x + k % 3) % kWidth] / 3.0;
        return values;
    });
    EXPECT_NEAR(s.deviation * std::sqrt(kWidth * kHeight), 3.0, 0.21);
    EXPECT_NEAR(s.standard_error / s.deviation, 69.0 / 81.0, 0.06);
}

// Where what is expected jumps from pixel to pixel, the standard error is never too small.
TEST(PixelMean, RoughPicturesAreLessSure) {
    std::mt19937 fixed(7);
    const std::vector<double> expected = noise(fixed);
    const Spread s = spread([&](std::mt19937& random) {
        std::vector<double> values = noise(random);
        for (size_t i = 0; i < values.size(); ++i) values[i] += 3.0 * expected[i];
        return values;
    });
    EXPECT_GT(s.standard_error, 2.0 * s.deviation);
}

}  // namespace gnomon::test
