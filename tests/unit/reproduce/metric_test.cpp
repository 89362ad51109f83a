// SPDX-License-Identifier: Apache-2.0
// Means with their standard errors, and how they are written.
#include "reproduce/metric.hpp"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::reproduce {
namespace {

TEST(Chance, IsStudentsT) {
    EXPECT_EQ(deviations_by_chance(0), 1.960);
    EXPECT_EQ(deviations_by_chance(1), 12.706);
    EXPECT_EQ(deviations_by_chance(2), 4.303);
    EXPECT_EQ(deviations_by_chance(10), 2.228);
    EXPECT_NEAR(deviations_by_chance(11), 2.201, 0.005);
    EXPECT_NEAR(deviations_by_chance(30), 2.042, 0.005);
    EXPECT_NEAR(deviations_by_chance(120), 1.980, 0.005);
    EXPECT_EQ(estimate(std::vector<double>{1.0, 2.0, 3.0}).freedom, 2u);
    EXPECT_EQ(estimate(std::vector<double>{1.0}).freedom, 0u);
}

TEST(Estimates, HandWorked) {
    const double values[] = {2.0, 4.0, 9.0};
    const Estimate e = estimate(values);
    EXPECT_DOUBLE_EQ(e.value, 5.0);
    // Squares of -3, -1, 4 are 26; 26 / 2 / 3 is the variance of the mean.
    EXPECT_DOUBLE_EQ(e.standard_error * e.standard_error, 13.0 / 3.0);
    EXPECT_EQ(estimate(std::span(values, 1)).standard_error, 0.0);
}

TEST(Estimates, DigitsFollowTheError) {
    EXPECT_EQ(shown({1.2345, 0.0321}), "1.23 ± 0.03");
    EXPECT_EQ(shown({263.4, 82.0}), "263 ± 82");
    EXPECT_EQ(shown({0.072834, 0.00041}), "0.0728 ± 0.0004");
    EXPECT_EQ(shown({0.0, 0.0}), "0");
    EXPECT_EQ(shown({0.0123456, 0.0}), "0.0123");
    EXPECT_EQ(shown({9.6e-5, 9.6e-5}), "0.00010 ± 0.00010");
}

TEST(Estimates, InTheMetricsUnit) {
    EXPECT_EQ(shown_with_unit(Metric::false_shadow, {0.0143, 0.0002}), "1.43 ± 0.02 %");
    EXPECT_EQ(shown_with_unit(Metric::seconds, {0.5, 0.0}), "500 ms");
    EXPECT_EQ(shown_with_unit(Metric::map_bytes, {1234567.0, 0.0}), "1,234,567 bytes");
    EXPECT_EQ(shown(Metric::ranges, {123.0, 0.0}), "123");
}

TEST(Metrics, EachIsListedOnce) {
    std::set<std::string> keys;
    for (const MetricInfo& m : metrics()) {
        EXPECT_TRUE(keys.insert(m.key).second) << m.key;
        EXPECT_EQ(&info(m.metric), &m);
    }
}

}  // namespace
}  // namespace gnomon::reproduce
