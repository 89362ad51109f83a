// SPDX-License-Identifier: Apache-2.0
// Errors between images, on numbers worked out by hand.
#include "io/image_compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::test {

using io::ChannelError;
using io::Metric;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

ChannelError compare(const std::vector<float>& a, const std::vector<float>& b) { return io::compare_channel("R", a, b); }

TEST(ImageCompare, WorkedByHand) {
    // Differences 3, 0, -4, 0: mean square 25 / 4. Largest reference 5.
    const ChannelError error = compare({3.0f, 1.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 5.0f, 0.0f});
    EXPECT_EQ(error.name, "R");
    EXPECT_DOUBLE_EQ(error.rmse, 2.5);
    EXPECT_DOUBLE_EQ(error.max, 4.0);
    EXPECT_DOUBLE_EQ(error.psnr, 20.0 * std::log10(2.0));
    EXPECT_DOUBLE_EQ(error.rel_mse, (9.0 / 0.01 + 16.0 / 25.01) / 4.0);
    EXPECT_EQ(error.compared, 4u);
    EXPECT_EQ(error.not_finite, 0u);
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
