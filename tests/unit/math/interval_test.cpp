// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/interval.h: roots worked out by hand, and random edges against their sign in double at many times.
#include "math/interval.h"

#include <gtest/gtest.h>

#include <random>

namespace gnomon::test {
namespace {

using shared::common_times;
using shared::EdgeQuadratic;
using shared::EdgeTimes;
using shared::times_not_negative;

// c + b u + a u^2
EdgeQuadratic quadratic(float c, float b, float a) { return {c, b + 2.0f * c, c + b + a}; }

double value_at(const EdgeQuadratic& e, double u) {
    return (1.0 - u) * (1.0 - u) * double(e.start) + u * (1.0 - u) * double(e.mixed) + u * u * double(e.end);
}

bool holds(const EdgeTimes& times, double u) {
    const bool in_gap = u > double(times.gap_lo) && u < double(times.gap_hi);
    return u >= double(times.lo) && u <= double(times.hi) && !in_gap;
}

void expect_times(const EdgeQuadratic& e, float lo, float hi, float gap_lo = 1.0f, float gap_hi = 1.0f) {
    const EdgeTimes times = times_not_negative(e);
    EXPECT_NEAR(times.lo, lo, 2e-7f);
    EXPECT_NEAR(times.hi, hi, 2e-7f);
    EXPECT_NEAR(times.gap_lo, gap_lo, 2e-7f);
    EXPECT_NEAR(times.gap_hi, gap_hi, 2e-7f);
}

void expect_never(const EdgeQuadratic& e) {
    const EdgeTimes times = times_not_negative(e);
    EXPECT_GE(times.lo, times.hi);
}

TEST(EdgeTimes, WorkedByHand) {
    for (float scale : {1.0f, 0x1p-100f, 0x1p100f}) {
        SCOPED_TRACE(scale);
        const auto of = [&](float c, float b, float a) { return quadratic(c * scale, b * scale, a * scale); };
        expect_times(of(1, 0, 0), 0, 1);
        expect_never(of(-1, 0, 0));
        expect_times(of(-1, 2, 0), 0.5f, 1);
        expect_times(of(1, -4, 0), 0, 0.25f);
        expect_times(of(0.1875f, -1, 1), 0, 1, 0.25f, 0.75f);  // (u - 1/4)(u - 3/4)
        expect_times(of(-0.1875f, 1, -1), 0.25f, 0.75f);       // its negative
        expect_times(of(-0.25f, 0.75f, 1), 0.25f, 1);          // (u - 1/4)(u + 1)
        expect_times(of(0.375f, -1, 0.5f), 0, 0.5f);           // (u - 1/2)(u - 3/2) / 2
        expect_times(of(0, -0.5f, 1), 0, 1, 0, 0.5f);          // u (u - 1/2)
        expect_times(of(0, 0.5f, -1), 0, 0.5f);                // its negative
        expect_times(of(0, 0, 0), 0, 1);
        expect_times(of(1, -2, 1), 0, 1);  // (u - 1)^2
        expect_never(of(-0.25f, 1, -1));   // -(u - 1/2)^2: a touch
        expect_never(of(-1, 1, -1));       // no real root
        expect_times(of(1, -1, 1), 0, 1);
        expect_times(of(-0.5f, 1, 1e-7f), 0.5f, 1);  // all but linear
    }
}

EdgeQuadratic random_edge(std::mt19937& random) {
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    const float scale = std::ldexp(1.0f, static_cast<int>(random() % 60) - 30);
    EdgeQuadratic e{number(random) * scale, 3.0f * number(random) * scale, number(random) * scale};
    // Now and then a zero at an end, no curvature, no slope, or a root that is nearly double.
    switch (random() % 10) {
        case 0:
            e.start = 0.0f;
            break;
        case 1:
            e.end = 0.0f;
            break;
        case 2:
            e.mixed = e.start + e.end;
            break;
        case 3:
            e.mixed = 0.0f;
            break;
        case 4:
            e.mixed = -2.0f * std::sqrt(std::fabs(e.start * e.end)) * (1.0f + number(random) * 1e-6f);
            break;
        default:
            break;
    }
    return e;
}

// Coefficients carry roundings of the float solution; nearer to zero than this a sign says nothing.
double rounding_of(const EdgeQuadratic& e) {
    return 4e-7 * (std::fabs(double(e.start)) + std::fabs(double(e.mixed)) + std::fabs(double(e.end)));
}

TEST(EdgeTimes, HaveTheSignOfManyTimes) {
    std::mt19937 random(41);
    uint64_t checked = 0;
    for (int i = 0; i < 20'000; ++i) {
        const EdgeQuadratic e = random_edge(random);
        const EdgeTimes times = times_not_negative(e);
        for (int step = 0; step <= 256; ++step) {
            const double u = step / 256.0, value = value_at(e, u);
            if (std::fabs(value) <= rounding_of(e)) continue;
            ++checked;
            ASSERT_EQ(holds(times, u), value > 0.0) << e.start << " " << e.mixed << " " << e.end << " at " << u;
        }
    }
    EXPECT_GT(checked, 5'000'000u);
}

// What one triangle loses the neighbour gains at the same instant, to the bit.
TEST(EdgeTimes, OfTheNegatedEdgeAreTheRest) {
    std::mt19937 random(42);
    for (int i = 0; i < 200'000; ++i) {
        const EdgeQuadratic e = random_edge(random);
        if (e.start == 0.0f || e.end == 0.0f) continue;  // Zero at an end belongs to both.
        const EdgeTimes times = times_not_negative(e), rest = times_not_negative({-e.start, -e.mixed, -e.end});
        const bool never = times.lo >= times.hi, gap = times.gap_lo < times.gap_hi;
        if (never) {
            ASSERT_EQ(rest.lo, 0.0f);
            ASSERT_EQ(rest.hi, 1.0f);
        } else if (gap) {
            ASSERT_EQ(rest.lo, times.gap_lo);
            ASSERT_EQ(rest.hi, times.gap_hi);
        } else if (times.lo > 0.0f && times.hi < 1.0f) {
            ASSERT_EQ(rest.gap_lo, times.lo);
            ASSERT_EQ(rest.gap_hi, times.hi);
        } else if (times.lo > 0.0f) {
            ASSERT_EQ(rest.hi, times.lo);
        } else if (times.hi < 1.0f) {
            ASSERT_EQ(rest.lo, times.hi);
        }
    }
}

TEST(Stays, FourOfThreeGaps) {
    const shared::Stays stays =
        common_times({0.0f, 1.0f, 0.625f, 0.75f}, {0.0f, 1.0f, 0.125f, 0.25f}, {0.0f, 1.0f, 0.375f, 0.5f});
    EXPECT_EQ(stays.enter, glm::vec4(0.0f, 0.25f, 0.5f, 0.75f));
    EXPECT_EQ(stays.leave, glm::vec4(0.125f, 0.375f, 0.625f, 1.0f));
}

TEST(Stays, AreTheTimesThatAllEdgesHave) {
    std::mt19937 random(43);
    std::array<uint64_t, 5> counts{};
    for (int i = 0; i < 100'000; ++i) {
        const EdgeTimes a = times_not_negative(random_edge(random)), b = times_not_negative(random_edge(random)),
                        c = times_not_negative(random_edge(random));
        const shared::Stays stays = common_times(a, b, c);
        size_t count = 0;
        for (int j = 0; j < 4; ++j) {
            if (stays.enter[j] >= stays.leave[j]) continue;
            ++count;
            if (j > 0) {
                ASSERT_GE(stays.enter[j], stays.leave[j - 1]);
            }
        }
        ++counts[count];
        for (int step = 0; step < 64; ++step) {
            const double u = (step + 0.5) / 64.0;
            bool in_stay = false;
            for (int j = 0; j < 4; ++j) in_stay = in_stay || (u > double(stays.enter[j]) && u < double(stays.leave[j]));
            bool on_end = false;
            for (int j = 0; j < 4; ++j) on_end = on_end || u == double(stays.enter[j]) || u == double(stays.leave[j]);
            if (!on_end) {
                ASSERT_EQ(in_stay, holds(a, u) && holds(b, u) && holds(c, u)) << u;
            }
        }
    }
    for (size_t n = 0; n < 4; ++n) EXPECT_GT(counts[n], 10u) << n << " stays";
}

// A triangle that moves to the right, over the point (0, 0) from its right corner to its left side.
TEST(Stays, OfATriangleThatPasses) {
    const float z = 5.0f;
    shared::CellTriangle c;
    c.a0 = {-4, -1, z, 1}, c.a1 = {-2, 0, z, 1}, c.a2 = {-4, 1, z, 1};
    c.b0 = {4, -1, z + 2, 1}, c.b1 = {6, 0, z + 2, 1}, c.b2 = {4, 1, z + 2, 1};
    const shared::PointPrism prism = point_prism(c, 0.0f, 0.0f);
    const shared::Stays stays = stays_over(prism);
    int found = 0;
    for (int j = 0; j < 4; ++j) {
        if (stays.enter[j] >= stays.leave[j]) continue;
        ++found;
        EXPECT_FLOAT_EQ(stays.enter[j], 0.25f);
        EXPECT_FLOAT_EQ(stays.leave[j], 0.5f);
        EXPECT_FLOAT_EQ(metres_at(prism, c, stays.enter[j], true), 5.5f);
        EXPECT_FLOAT_EQ(metres_at(prism, c, stays.leave[j], true), 6.0f);
    }
    EXPECT_EQ(found, 1);
    std::swap(c.a1, c.a2);
    std::swap(c.b1, c.b2);
    const shared::Stays reversed = stays_over(point_prism(c, 0.0f, 0.0f));
    for (int j = 0; j < 4; ++j) EXPECT_GE(reversed.enter[j], reversed.leave[j]);
}

TEST(Stays, OfAPointAreNone) {
    shared::CellTriangle c;
    c.a0 = c.a1 = c.a2 = glm::vec4(0.1f, 0.3f, 5.0f, 1.0f);
    c.b0 = c.b1 = c.b2 = glm::vec4(0.7f, -0.3f, 5.0f, 1.0f);
    const shared::Stays stays = stays_over(point_prism(c, 0.25f, 0.5f));
    for (int j = 0; j < 4; ++j) EXPECT_GE(stays.enter[j], stays.leave[j]);
}

}  // namespace
}  // namespace gnomon::test
