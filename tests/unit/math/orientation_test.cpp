// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/orientation.h: no orientation in which a triangle is really seen is missed, and few are claimed without
// need.
#include "math/orientation.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "math/texel_range.h"
#include "oracle/prism_kinds.hpp"

namespace gnomon::test {
namespace {

using oracle::PrismKind;

glm::vec3 flat(float x, float y) { return {x, y, 1.0f}; }

// Corners (0, 0), (4, 0), (0, 4) go clockwise with y down.
TEST(Orientations, OfKnownTriangles) {
    const glm::vec3 o = flat(0, 0), right = flat(4, 0), down = flat(0, 4), up = flat(0, -4);
    EXPECT_EQ(shared::orientations(o, right, down, o, right, down, 32.0f), shared::kSeenPositive);
    EXPECT_EQ(shared::orientations(o, down, right, o, down, right, 32.0f), shared::kSeenNegative);
    EXPECT_EQ(shared::orientations(o, right, down, o, right, up, 32.0f), shared::kSeenPositive | shared::kSeenNegative)
        << "turns over";
}

uint32_t whole_segment(const oracle::Prism& p, float extent) {
    const glm::vec4 d0 = p.end[0] - p.start[0], d1 = p.end[1] - p.start[1], d2 = p.end[2] - p.start[2];
    const shared::CellTriangle cell = shared::cell_triangle(p.start[0], p.start[1], p.start[2], d0, d1, d2, 0.0f, 1.0f);
    return shared::prism_orientations(p.start[0], p.start[1], p.start[2], d0, d1, d2, cell, extent);
}

TEST(Orientations, NoneWithoutArea) {
    const glm::vec4 p(1.1f, 2.2f, 3, 1), q(4.4f, 5.5f, 1, 1), r(1.1f, 7, 9, 1), far(1.1f, 9, 9, 4);
    EXPECT_EQ(whole_segment({{p, q, q}, {q, r, r}}, 32.0f), 0u) << "two vertices are one";
    EXPECT_NE(whole_segment({{p, q, q}, {p, q, r}}, 32.0f), 0u) << "but only at first";
    EXPECT_EQ(whole_segment({{p, r, p}, {p, r, p}}, 32.0f), 0u);
    const glm::vec4 s(1.1f, -3, 9, 1);
    EXPECT_EQ(whole_segment({{p, r, s}, {p, r, s}}, 32.0f), 0u) << "a wall along a column, seen edge-on";
    EXPECT_NE(whole_segment({{p, r, far}, {p, r, far}}, 32.0f), 0u) << "in perspective it has area";
}

TEST(Orientations, MissesNoneThatIsSeen) {
    uint64_t seen = 0, needless = 0, claimed = 0;
    for (int i = 0; i < 300'000; ++i) {
        std::mt19937 random(static_cast<uint32_t>(i));
        const auto kind = static_cast<PrismKind>(i % oracle::kPrismKinds);
        const float extent = i % 2 == 0 ? 32.0f : 8192.0f;
        const double corner = std::uniform_real_distribution<double>(-extent, extent - 1.0)(random);
        const oracle::Prism p = oracle::make_prism(kind, i % 3 == 0, glm::dvec2(corner, -corner), random);
        const uint32_t mask = whole_segment(p, extent);
        uint32_t truth = 0;
        const oracle::Box everything{glm::dvec2(-1e9), glm::dvec2(1e9)};
        for (int step = 0; step <= 16; ++step) {
            const std::optional<bool> positive = orientation_in(exact(p), everything, step / 16.0);
            if (positive) truth |= *positive ? shared::kSeenPositive : shared::kSeenNegative;
        }
        ASSERT_EQ(truth & ~mask, 0u) << oracle::name_of(kind) << ", case " << i;
        seen += std::popcount(truth);
        if (kind == PrismKind::random || kind == PrismKind::motionless) {
            claimed += std::popcount(mask);
            needless += std::popcount(mask & ~truth);
        }
    }
    std::printf("%llu orientations seen; of random and motionless prisms %.1f %% of the claimed ones are needless\n",
                static_cast<unsigned long long>(seen), 100.0 * static_cast<double>(needless) / static_cast<double>(claimed));
    EXPECT_GT(seen, 200'000u);
    EXPECT_LT(needless, claimed / 4);
}

}  // namespace
}  // namespace gnomon::test
