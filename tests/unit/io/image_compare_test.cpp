// SPDX-License-Identifier: Apache-2.0
// Errors between images, on numbers worked out by hand.
#include "io/image_compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace gnomon::test {

using io::ChannelError;
using io::Metric;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

ChannelError compare(const std::vector<float>& a, const std::vector<float>& b) {
    return io::compare_channel("R", a, b, static_cast<uint32_t>(a.size()));
}

TEST(ImageCompare, WorkedByHand) {
    // Differences 3, 0, -4, 0: mean square 25 / 4. Largest reference 5.
    const ChannelError error = compare({3.0f, 1.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 5.0f, 0.0f});
    EXPECT_EQ(error.name, "R");
    EXPECT_DOUBLE_EQ(error.bias, -0.25);
    EXPECT_DOUBLE_EQ(error.rmse, 2.5);
    EXPECT_DOUBLE_EQ(error.max, 4.0);
    EXPECT_DOUBLE_EQ(error.psnr, 20.0 * std::log10(2.0));
    EXPECT_DOUBLE_EQ(error.rel_mse, (9.0 / 0.01 + 16.0 / 25.01) / 4.0);
    EXPECT_EQ(error.compared, 4u);
    EXPECT_EQ(error.not_finite, 0u);
}

// Two blocks of two pixels. Differences 3, 0 and -4, 0: sums less the mean 3.5 and -3.5. Squares: 9, 0, 16, 0, sums less the
// mean -3.5 and 3.5, so the mean square 6.25 has the standard error 7 / 4, and its root 2.5 that over 5.
TEST(ImageCompare, StandardErrorsWorkedByHand) {
    const ChannelError error = compare({3.0f, 1.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 5.0f, 0.0f});
    EXPECT_DOUBLE_EQ(error.bias_standard_error, 7.0 / 4.0);
    EXPECT_DOUBLE_EQ(error.rmse_standard_error, 7.0 / 4.0 / 5.0);
    EXPECT_DOUBLE_EQ(error.rel_mse_standard_error, (9.0 / 0.01 - 16.0 / 25.01) / 4.0);
    EXPECT_FALSE(error.noise);
    EXPECT_EQ(compare({1.0f, 2.0f}, {1.0f, 2.0f}).rmse_standard_error, 0.0);
    EXPECT_TRUE(std::isnan(compare({1.0f}, {2.0f}).rmse_standard_error));
}

// Variances 5, 0, 8, 0 of squares 9, 0, 16, 0.
TEST(ImageCompare, NoiseWorkedByHand) {
    const std::vector<float> a = {3.0f, 1.0f, 1.0f, 0.0f}, b = {0.0f, 1.0f, 5.0f, 0.0f};
    const std::vector<double> variances = {5.0, 0.0, 8.0, 0.0};
    const ChannelError error = io::compare_channel("visibility.0", a, b, 4, {variances, {}});
    ASSERT_TRUE(error.noise);
    EXPECT_DOUBLE_EQ(error.noise->variance, 13.0 / 4.0);
    EXPECT_DOUBLE_EQ(error.noise->share, 13.0 / 25.0);
    EXPECT_DOUBLE_EQ(error.noise->mse_without, 3.0);
    EXPECT_DOUBLE_EQ(error.noise->mse_without_standard_error, 1.0);  // Sums less the mean: -2 and 2.
    EXPECT_DOUBLE_EQ(error.rmse, 2.5);

    const std::vector<double> unknown = {kNan, 0.0, 0.0, 0.0};
    EXPECT_EQ(io::compare_channel("visibility.0", a, b, 4, {unknown, {}}).not_finite, 1u);
    EXPECT_TRUE(std::isnan(io::compare_channel("visibility.0", b, b, 4, {variances, {}}).noise->share));
}

// Seen again a is 1, 1, 1, 2: a pixel's variance is half of the squared difference, 2, 0, 0, 2. Differences from b are 3, 0,
// -4, 0 and 1, 0, -4, 2: from each other 2, 0, 0, -2; as sums of two 2 and -2, hence 4 / 4 over sqrt(2). Squares 9, 0, 16, 0
// and 1, 0, 16, 4: from each other 8, 0, 0, -4; less the mean 6 and -6, hence 12 / 4 over sqrt(2), and that over 5.
TEST(ImageCompare, SecondRenderWorkedByHand) {
    const std::vector<float> a = {3.0f, 1.0f, 1.0f, 0.0f}, b = {0.0f, 1.0f, 5.0f, 0.0f}, again = {1.0f, 1.0f, 1.0f, 2.0f};
    const ChannelError error = io::compare_channel("R", a, b, 4, {{}, again});
    EXPECT_DOUBLE_EQ(error.bias, -0.25);
    EXPECT_DOUBLE_EQ(error.rmse, 2.5);
    EXPECT_DOUBLE_EQ(error.bias_standard_error, 1.0 / std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(error.rmse_standard_error, 3.0 / std::sqrt(2.0) / 5.0);
    // 8 / 0.01, 0, 0, -4 / 0.01.
    EXPECT_DOUBLE_EQ(error.rel_mse_standard_error, 1200.0 / 4.0 / std::sqrt(2.0));
    ASSERT_TRUE(error.noise);
    EXPECT_DOUBLE_EQ(error.noise->variance, 1.0);
    EXPECT_DOUBLE_EQ(error.noise->share, 1.0 / 6.25);
    EXPECT_DOUBLE_EQ(error.noise->mse_without, 5.25);
    EXPECT_EQ(io::compare_channel("R", a, b, 4, {{}, std::vector<float>{kInfinity, 0.0f, 0.0f, 0.0f}}).not_finite, 1u);
}

namespace {

constexpr uint32_t kWidth = 64, kHeight = 48, kSeeds = 1000;

/// An estimate over many seeds.
struct Tally {
    double sum = 0.0, squares = 0.0, variances = 0.0;

    void add(double value, double standard_error) {
        sum += value;
        squares += value * value;
        variances += standard_error * standard_error;
    }
    double mean() const { return sum / kSeeds; }
    double deviation() const { return std::sqrt(squares / kSeeds - mean() * mean()); }
    double standard_error() const { return std::sqrt(variances / kSeeds); }
};

}  // namespace

// Visibilities with known expectations, as many independent samples see them: over many seeds the mean of the bias and of
// rmse^2 without noise are right, and the standard errors are the spread.
TEST(ImageCompare, StandardErrorsAreTheSpread) {
    constexpr int kSamplesA = 4, kSamplesB = 16;
    Tally bias, rmse, mse_without;
    double true_bias = 0.0, true_mse = 0.0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        std::mt19937 random(seed);
        std::vector<float> a, b;
        std::vector<double> variances(kWidth * kHeight, 0.0);
        true_bias = true_mse = 0.0;
        const auto sample = [&](int n, double p, std::vector<float>& means) {
            const double mean = static_cast<double>(std::binomial_distribution<int>(n, p)(random)) / n;
            variances[means.size()] += mean * (1.0 - mean) / (n - 1);
            means.push_back(static_cast<float>(mean));
        };
        for (uint32_t i = 0; i < kWidth * kHeight; ++i) {  // A penumbra, and a false shadow in it.
            const double x = (i % kWidth + 0.5) / kWidth, y = (i / kWidth + 0.5) / kHeight;
            const double p_b = x, p_a = x * (1.0 - 0.3 * y);
            sample(kSamplesA, p_a, a);
            sample(kSamplesB, p_b, b);
            true_bias += (p_a - p_b) / (kWidth * kHeight);
            true_mse += (p_a - p_b) * (p_a - p_b) / (kWidth * kHeight);
        }
        const ChannelError error = io::compare_channel("visibility.0", a, b, kWidth, {variances, {}});
        bias.add(error.bias, error.bias_standard_error);
        rmse.add(error.rmse, error.rmse_standard_error);
        mse_without.add(error.noise->mse_without, error.noise->mse_without_standard_error);
    }
    const double seeds_root = std::sqrt(kSeeds);
    EXPECT_NEAR(bias.mean(), true_bias, 4.0 * bias.deviation() / seeds_root);
    EXPECT_NEAR(mse_without.mean(), true_mse, 4.0 * mse_without.deviation() / seeds_root);
    EXPECT_LT(4.0 * mse_without.deviation() / seeds_root, 0.03 * true_mse);  // Of which the noise is five times as much.
    for (const Tally* tally : {&bias, &rmse, &mse_without})
        EXPECT_NEAR(tally->standard_error() / tally->deviation(), 1.0, 0.07);
}

// False shadows in random pixels, and noise that 3 x 3 pixels share and that is more where it is bright: with a second render
// the standard errors are the spread over the seeds nevertheless, and the noise and the error without it are right. Blocks of 7
// pixels miss what reaches over their borders (see pixel_mean_test.cpp): about a fifth.
TEST(ImageCompare, SecondRenderTellsTheSpread) {
    std::mt19937 fixed(5);
    std::vector<float> b(kWidth * kHeight), expected(kWidth * kHeight);
    double true_mse = 0.0, true_variance = 0.0;
    for (size_t i = 0; i < b.size(); ++i) {
        b[i] = static_cast<float>(i % kWidth) / kWidth;
        expected[i] = b[i] - (fixed() % 8 == 0 ? 0.5f : 0.0f);
        true_mse += (expected[i] - b[i]) * (expected[i] - b[i]) / static_cast<double>(b.size());
        true_variance += b[i] * b[i] / static_cast<double>(b.size());
    }
    const auto render = [&](std::mt19937& random) {
        std::normal_distribution<float> normal;
        std::vector<float> white(b.size()), values = expected;
        for (float& value : white) value = normal(random);
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x)
                for (uint32_t k = 0; k < 9; ++k)
                    values[y * kWidth + x] +=
                        b[y * kWidth + x] / 3.0f * white[(y + k / 3) % kHeight * kWidth + (x + k % 3) % kWidth];
        return values;
    };
    Tally bias, rmse, mse_without, variance;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        std::mt19937 random(seed);
        const std::vector<float> a = render(random), again = render(random);
        const ChannelError error = io::compare_channel("R", a, b, kWidth, {{}, again});
        bias.add(error.bias, error.bias_standard_error);
        rmse.add(error.rmse, error.rmse_standard_error);
        mse_without.add(error.noise->mse_without, 0.0);
        variance.add(error.noise->variance, 0.0);
    }
    for (const auto& [tally, truth] : {std::pair(&mse_without, true_mse), std::pair(&variance, true_variance)})
        EXPECT_NEAR(tally->mean(), truth, 4.0 * tally->deviation() / std::sqrt(kSeeds));
    for (const Tally* tally : {&bias, &rmse}) {
        EXPECT_GT(tally->standard_error() / tally->deviation(), 0.75);
        EXPECT_LT(tally->standard_error() / tally->deviation(), 1.0);
    }
}

TEST(ImageCompare, EqualImagesHaveNoError) {
    const ChannelError error = compare({1.0f, -2.0f}, {1.0f, -2.0f});
    EXPECT_EQ(error.rmse, 0.0);
    EXPECT_EQ(error.max, 0.0);
    EXPECT_EQ(error.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(error.rel_mse, 0.0);
}

TEST(ImageCompare, PeakIsThatOfTheReferenceAndOneWhereItIsBlack) {
    EXPECT_DOUBLE_EQ(compare({0.0f}, {-10.0f}).psnr, 0.0);   // Error 10, peak 10.
    EXPECT_DOUBLE_EQ(compare({10.0f}, {0.0f}).psnr, -20.0);  // Error 10, peak 1.
}

TEST(ImageCompare, WhatIsNotFiniteIsCountedAndLeftOut) {
    const ChannelError error = compare({kNan, 2.0f, kInfinity, kNan}, {1.0f, 1.0f, kInfinity, kNan});
    EXPECT_EQ(error.not_finite, 3u);
    EXPECT_EQ(error.compared, 1u);
    EXPECT_DOUBLE_EQ(error.rmse, 1.0);
    const ChannelError none = compare({kNan}, {0.0f});
    EXPECT_EQ(none.compared, 0u);
    EXPECT_EQ(none.rmse, 0.0);
    EXPECT_EQ(none.rel_mse, 0.0);
}

TEST(ImageCompare, DifferencesAreTakenInDouble) {
    // In float, 1 + 2^-24 - 1 would be 0 and 3e38 squared infinite.
    EXPECT_DOUBLE_EQ(compare({3e38f}, {-3e38f}).max, 2.0 * 3e38f);
    EXPECT_TRUE(std::isfinite(compare({3e38f}, {-3e38f}).rmse));
}

TEST(ImageCompare, OverTheThreshold) {
    const ChannelError error{.name = "R", .rmse = 1.0, .max = 2.0, .psnr = 30.0, .rel_mse = 0.5, .compared = 1};
    EXPECT_FALSE(io::is_over(error, Metric::rmse, 1.0));
    EXPECT_TRUE(io::is_over(error, Metric::rmse, 0.99));
    EXPECT_FALSE(io::is_over(error, Metric::max, 2.0));
    EXPECT_TRUE(io::is_over(error, Metric::max, 1.99));
    EXPECT_FALSE(io::is_over(error, Metric::psnr, 30.0));
    EXPECT_TRUE(io::is_over(error, Metric::psnr, 30.01));
    EXPECT_FALSE(io::is_over(error, Metric::rel_mse, 0.5));
    EXPECT_TRUE(io::is_over(error, Metric::rel_mse, 0.49));
}

TEST(ImageCompare, WhatIsNotFiniteIsOverAnyThreshold) {
    EXPECT_TRUE(io::is_over(compare({kNan, 1.0f}, {1.0f, 1.0f}), Metric::rmse, 1e9));
    EXPECT_TRUE(io::is_over(compare({kNan, 1.0f}, {1.0f, 1.0f}), Metric::psnr, 0.0));
}

}  // namespace gnomon::test
