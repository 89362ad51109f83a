// SPDX-License-Identifier: Apache-2.0
// Errors against a reference, on frames of a few pixels.
#include "reproduce/errors.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace gnomon::reproduce {
namespace {

// One row of pixels under one light.
Frame frame(const std::vector<float>& alpha, const std::vector<float>& visibility) {
    Frame f;
    f.width = static_cast<uint32_t>(alpha.size());
    f.height = 1;
    f.light_count = 1;
    f.channels = {{"A", alpha}, {"visibility.0", visibility}};
    return f;
}

TEST(FalseShares, SamplesAreComparedOneByOne) {
    Frame a, b;
    a.light_count = b.light_count = 2;
    constexpr uint32_t kMiss = SampleRecord::kMiss;
    // Both lights agree; one falsely dark and one falsely lit; another triangle; a miss.
    a.samples = {{1, 1.0f, 0b11}, {1, 1.0f, 0b10}, {2, 1.0f, 0b00}, {kMiss, 0.0f, 0}};
    b.samples = {{1, 1.0f, 0b11}, {1, 1.0f, 0b01}, {3, 1.0f, 0b11}, {kMiss, 0.0f, 3}};
    const FalseShare share = false_share(a, b);
    EXPECT_DOUBLE_EQ(share.shadow, 0.25);
    EXPECT_DOUBLE_EQ(share.light, 0.25);
    a.samples[1].lit = 0b00;
    EXPECT_DOUBLE_EQ(false_share(a, b).shadow, 0.25);
    EXPECT_DOUBLE_EQ(false_share(a, b).light, 0.0);
}

TEST(FalseShares, SharesOfLightCountByHowMuch) {
    Frame a, b;
    a.light_count = b.light_count = 1;
    a.samples = {{1, 1.0f, 0}, {1, 1.0f, 0}};
    a.sample_visibility = {0.75f, 0.25f};
    b.samples = {{1, 1.0f, 1}, {1, 1.0f, 0}};
    EXPECT_DOUBLE_EQ(false_share(a, b).shadow, 0.125);
    EXPECT_DOUBLE_EQ(false_share(a, b).light, 0.125);
}

TEST(VisibilityErrors, OnlyWhereBothHaveHits) {
    const Frame a = frame({1.0f, 1.0f, 0.0f, 1.0f}, {0.5f, 1.0f, 1.0f, 1.0f});
    const Frame b = frame({1.0f, 0.5f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f});
    EXPECT_DOUBLE_EQ(visibility_error(a, b), std::sqrt((0.25 + 1.0) / 2.0));
    EXPECT_THAT(visibility_difference(a, b), testing::ElementsAre(0.5, 1.0, 0.0, 0.0));
}

TEST(Noise, TakenFromTheErrorLeavesWhatIsSystematic) {
    const Estimate rest = without_noise({0.5, 0.01}, {0.3, 0.0});
    EXPECT_DOUBLE_EQ(rest.value, 0.4);
    EXPECT_DOUBLE_EQ(rest.standard_error, 0.5 * 0.01 / 0.4);
    EXPECT_EQ(without_noise({0.3, 0.0}, {0.5, 0.0}).value, 0.0);
    // The square is 0 within 0.006.
    EXPECT_DOUBLE_EQ(without_noise({0.3, 0.01}, {0.3, 0.0}).standard_error, std::sqrt(0.006));
}

TEST(Noise, IsTheRootOfTheMeanVariance) {
    VisibilityVariance variance;
    variance.add(frame({1.0f, 1.0f, 1.0f}, {0.0f, 0.5f, 0.0f}));
    EXPECT_FALSE(variance.noise());
    variance.add(frame({1.0f, 1.0f, 0.0f}, {1.0f, 0.5f, 1.0f}));
    // Variances 1/2 and 0; the third pixel has no hit in one of the frames.
    ASSERT_TRUE(variance.noise());
    EXPECT_DOUBLE_EQ(variance.noise()->value, 0.5);
    EXPECT_DOUBLE_EQ(variance.noise()->standard_error, 0.25 / (2.0 * 0.5));
}

}  // namespace
}  // namespace gnomon::reproduce
