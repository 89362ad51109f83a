// SPDX-License-Identifier: Apache-2.0
// What repeated measurements say, of numbers worked by hand.
#include "timing/summary.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace gnomon::timing {
namespace {

using testing::ElementsAre;

TEST(Summary, OddNumbersOfSamples) {
    const Summary odd = summarize({9.0, 1.0, 3.0, 7.0, 5.0});
    EXPECT_THAT(odd.samples, ElementsAre(9.0, 1.0, 3.0, 7.0, 5.0));
    EXPECT_EQ(odd.median, 5.0);
    EXPECT_EQ(odd.q1, 3.0);
    EXPECT_EQ(odd.q3, 7.0);
    EXPECT_EQ(odd.least, 1.0);
    EXPECT_EQ(odd.most, 9.0);
}

// Ranks 0.75, 1.5 and 2.25 of 0 to 3.
TEST(Summary, EvenNumbersOfSamplesAreBetweenTwo) {
    const Summary even = summarize({4.0, 1.0, 2.0, 9.0});
    EXPECT_EQ(even.median, 3.0);
    EXPECT_EQ(even.q1, 1.75);
    EXPECT_EQ(even.q3, 5.25);
}

TEST(Summary, OneSampleIsAllThereIs) {
    const Summary one = summarize({5.0});
    EXPECT_EQ(one.median, 5.0);
    EXPECT_EQ(one.q1, 5.0);
    EXPECT_EQ(one.q3, 5.0);
    EXPECT_EQ(standard_deviation({5.0}), 0.0);
}

// 2, 4, 4, 4, 5, 5, 7, 9 are from their mean 5: squares 9, 1, 1, 1, 0, 0, 4, 16, the sum 32.
TEST(Summary, MeanAndDeviation) {
    const std::vector<double> samples = {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
    EXPECT_EQ(mean(samples), 5.0);
    EXPECT_DOUBLE_EQ(standard_deviation(samples), std::sqrt(32.0 / 7.0));
}

}  // namespace
}  // namespace gnomon::timing
