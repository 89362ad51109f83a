// SPDX-License-Identifier: Apache-2.0
// Intervals by order statistics, and verdicts, of numbers worked by hand.
#include "timing/comparison.hpp"

#include <gmock/gmock.h>

#include <numeric>

namespace gnomon::timing {
namespace {

// n, n - 1, ... 1: the k-th least is k.
std::vector<double> countdown(size_t n) {
    std::vector<double> values(n);
    std::iota(values.rbegin(), values.rend(), 1.0);
    return values;
}

void expect_interval(size_t n, double low, double high, double confidence = 0.95) {
    const std::optional<Interval> interval = median_interval(countdown(n), confidence);
    ASSERT_TRUE(interval) << n;
    EXPECT_EQ(interval->low, low) << n;
    EXPECT_EQ(interval->high, high) << n;
}

// The median lies outside of the k-th least and the k-th most with a chance of 2 (C(n, 0) + ... + C(n, k - 1)) / 2^n.
TEST(MedianInterval, IsOfTheSignTest) {
    // 2 / 32 is more than 0.05, 2 / 64 is not, 2 (1 + 6) / 64 is.
    EXPECT_FALSE(median_interval({}));
    EXPECT_FALSE(median_interval(countdown(1)));
    EXPECT_FALSE(median_interval(countdown(5)));
    expect_interval(6, 1, 6);
    // 2 (1 + 8) / 256 = 0.0703; 2 (1 + 9) / 512 = 0.0391, 2 (1 + 9 + 36) / 512 = 0.18.
    expect_interval(8, 1, 8);
    expect_interval(9, 2, 8);
    // As the tables have it: 2 (1 + 15 + 105 + 455) / 32768 = 0.0352, with 1365 more 0.118.
    expect_interval(15, 4, 12);
    // Ranks 40 and 61 of 100: 0.0352; 41 and 60: 0.0569.
    expect_interval(100, 40, 61);
    // Less sure is narrower: 2 (1 + 9 + 36) / 512 = 0.18.
    expect_interval(9, 3, 7, 0.8);
    // Numbers of ways that no double holds.
    EXPECT_TRUE(median_interval(countdown(3000)));
}

TEST(Verdict, IsSaidByTheInterval) {
    const auto verdict = [](double low, double high, size_t pairs = 9) { return verdict_of(Interval{low, high}, pairs); };
    EXPECT_EQ(verdict(0.5, 0.99), Verdict::faster);
    EXPECT_EQ(verdict(0.5, 1.0), Verdict::undecided);
    EXPECT_EQ(verdict(1.01, 1.5), Verdict::slower);
    EXPECT_EQ(verdict(0.9, 1.1), Verdict::undecided);
    EXPECT_EQ(verdict(0.98, 1.02), Verdict::same);
    EXPECT_EQ(verdict(0.985, 0.995), Verdict::same);  // Faster, and nobody need care.
    EXPECT_EQ(verdict(0.979, 0.995), Verdict::faster);
    EXPECT_EQ(verdict(0.5, 0.6, 8), Verdict::undecided);
    EXPECT_EQ(verdict_of(std::nullopt, 9), Verdict::undecided);
    EXPECT_EQ(
        to_string(Verdict::faster) + to_string(Verdict::slower) + to_string(Verdict::same) + to_string(Verdict::undecided),
        "fasterslowersameundecided");
}

TEST(Comparison, IsOfPairs) {
    // A machine that gets slower and slower: of each pair the first takes half of the second.
    std::vector<double> seconds, baseline;
    for (int i = 1; i <= 9; ++i) {
        baseline.push_back(i);
        seconds.push_back(i * 0.5);
    }
    seconds[0] = 3.0;  // Something else ran.
    const std::optional<Comparison> found = compare(seconds, baseline);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->pairs, 9u);
    EXPECT_EQ(found->ratio, 0.5);
    EXPECT_EQ(found->interval->low, 0.5);
    EXPECT_EQ(found->interval->high, 0.5);
    EXPECT_EQ(found->verdict, Verdict::faster);
    EXPECT_EQ(compare(baseline, baseline)->verdict, Verdict::same);
    EXPECT_EQ(compare({1.0, 2.0}, {2.0, 2.0})->ratio, 0.75);
    EXPECT_FALSE(compare({1.0, 2.0}, {2.0, 2.0})->interval);
    EXPECT_FALSE(compare({1.0, 1.0}, {1.0, 0.0}));
    EXPECT_FALSE(compare({}, {}));
}

}  // namespace
}  // namespace gnomon::timing
