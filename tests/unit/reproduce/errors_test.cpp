// SPDX-License-Identifier: Apache-2.0
// Errors against a reference, on frames of a few pixels.
#include "reproduce/errors.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

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

TEST(VisibilityDifference, OnlyWhereBothHaveHits) {
    const Frame a = frame({1.0f, 1.0f, 0.0f, 1.0f}, {0.5f, 1.0f, 1.0f, 1.0f});
    const Frame b = frame({1.0f, 0.5f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f});
    EXPECT_THAT(visibility_difference(a, b), testing::ElementsAre(0.5, 1.0, 0.0, 0.0));
}

TEST(Roots, OfMeanSquares) {
    const Estimate root = root_of({0.16, 0.01});
    EXPECT_DOUBLE_EQ(root.value, 0.4);
    EXPECT_DOUBLE_EQ(root.standard_error, 0.01 / 0.8);
    // The square is 0 within 0.006.
    EXPECT_EQ(root_of({-0.003, 0.006}).value, 0.0);
    EXPECT_DOUBLE_EQ(root_of({-0.003, 0.006}).standard_error, std::sqrt(0.006));
    EXPECT_DOUBLE_EQ(root_of({1e-9, 0.006}).standard_error, std::sqrt(0.006));
}

// Visibilities 0, 1 and 1; 0.5 three times; a pixel without a hit in one frame; one without a hit of the reference's.
class ThreeFrames : public testing::Test {
protected:
    ThreeFrames() {
        statistics.add(frame({1.0f, 1.0f, 1.0f, 1.0f}, {0.0f, 0.5f, 0.0f, 1.0f}));
        statistics.add(frame({1.0f, 1.0f, 0.0f, 1.0f}, {1.0f, 0.5f, 1.0f, 1.0f}));
        statistics.add(frame({1.0f, 1.0f, 1.0f, 1.0f}, {1.0f, 0.5f, 1.0f, 1.0f}));
    }

    const Frame reference = frame({1.0f, 1.0f, 1.0f, 0.0f}, {0.5f, 0.25f, 0.5f, 1.0f});
    VisibilityStatistics statistics;
};

TEST_F(ThreeFrames, NoiseIsTheVariance) {
    const PixelSquares noise = statistics.noise();
    EXPECT_DOUBLE_EQ(noise.all[0], 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(noise.all[1], 0.0);
    EXPECT_TRUE(std::isnan(noise.all[2]));
    ASSERT_EQ(noise.without.size(), 3u);
    EXPECT_DOUBLE_EQ(noise.without[0][0], 0.0);
    EXPECT_DOUBLE_EQ(noise.without[1][0], 0.5);
}

TEST_F(ThreeFrames, ErrorIsNoiseAndWhatIsSystematic) {
    const PixelSquares error = statistics.error(reference), systematic = statistics.systematic(reference);
    EXPECT_DOUBLE_EQ(error.all[0], 0.25);
    EXPECT_DOUBLE_EQ(error.all[1], 0.0625);
    // The mean 2/3 is 1/6 from the reference and has a variance of 1/3 / 3.
    EXPECT_DOUBLE_EQ(systematic.all[0], 1.0 / 36.0 - 1.0 / 9.0);
    EXPECT_DOUBLE_EQ(systematic.all[1], 0.0625);
    EXPECT_TRUE(std::isnan(systematic.all[2]));
    EXPECT_TRUE(std::isnan(systematic.all[3]));
    EXPECT_DOUBLE_EQ(systematic.without[0][0], 0.25);
    EXPECT_DOUBLE_EQ(systematic.without[1][0], -0.25);
}

TEST_F(ThreeFrames, DifferencesArePixelByPixel) {
    const PixelSquares error = statistics.error(reference), more = difference(error, -3.0, error);
    EXPECT_DOUBLE_EQ(more.all[1], 0.25);
    EXPECT_DOUBLE_EQ(more.without[2][1], 0.25);
}

TEST(OverSeeds, TheJackknifeOfBlocks) {
    // Two blocks of one row; without each of the seeds the sums are 1, 2, 3 and 0, 0, 3.
    PixelSquares squares{std::vector<double>(32, std::nan("")), {}};
    for (const auto& [left, right] : {std::pair(1.0, 0.0), std::pair(2.0, 0.0), std::pair(3.0, 3.0)}) {
        squares.without.emplace_back(32, std::nan(""));
        squares.without.back()[3] = left;
        squares.without.back()[20] = right;
    }
    squares.all[3] = 2.0;
    squares.all[20] = 1.0;
    const Estimate mean = over_seeds(squares, 32);
    EXPECT_DOUBLE_EQ(mean.value, 1.5);
    // Sums of squares about the middle: 2 and 6; two thirds of them.
    EXPECT_DOUBLE_EQ(mean.standard_error, std::sqrt(8.0 * 2.0 / 3.0) / 2.0);
}

// Pixels of one probability of light, whose frames are independent: over many experiments the estimates' mean is the truth and
// their spread the standard error.
TEST(OverSeeds, EstimatesHaveNoBiasAndTheirStandardErrors) {
    constexpr uint32_t kSide = 64, kPixels = kSide * kSide;
    constexpr int kExperiments = 60;
    const std::vector<float> alpha(kPixels, 1.0f);
    Frame reference = frame(alpha, std::vector<float>(kPixels, 0.6f));
    std::mt19937 random(5);
    std::bernoulli_distribution lit(0.7);
    double sum = 0.0, squares = 0.0, claimed = 0.0;
    for (int experiment = 0; experiment < kExperiments; ++experiment) {
        VisibilityStatistics statistics;
        for (int seed = 0; seed < 3; ++seed) {
            std::vector<float> values(kPixels);
            for (float& v : values) v = lit(random) ? 1.0f : 0.0f;
            statistics.add(frame(alpha, values));
        }
        const Estimate mean = over_seeds(statistics.systematic(reference), kSide);
        sum += mean.value;
        squares += mean.value * mean.value;
        claimed += mean.standard_error * mean.standard_error;
    }
    const double mean = sum / kExperiments, variance = squares / kExperiments - mean * mean;
    EXPECT_NEAR(mean, 0.01, 4.0 * std::sqrt(variance / kExperiments));
    // A variance of 60 is known to a fifth. Of products of two frames, of three, the jackknife says up to four times too much.
    EXPECT_GT(claimed / kExperiments, 0.6 * variance);
    EXPECT_LT(claimed / kExperiments, 6.0 * variance);
}

}  // namespace
}  // namespace gnomon::reproduce
