// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/texel_range.h: prisms that are beside the image, also behind the eye, touch none of it.
#include <gtest/gtest.h>

#include <iostream>

#include "math/texel_range.h"
#include "oracle/prism_kinds.hpp"

namespace gnomon::test {
namespace {

using oracle::PrismKind;

shared::CellTriangle still(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c) { return {a, b, c, a, b, c}; }

// An image of half size 2 x 1. At w = 1 its right side is at x = 2, at w = -1 at x = -2.
TEST(BesideImage, KnownTriangles) {
    const glm::vec2 half(2, 1);
    const auto beside = [&](const glm::vec4& a, const glm::vec4& b, const glm::vec4& c) {
        return shared::beside_image(still(a, b, c), half, 1e-6f);
    };
    const glm::vec4 right(3, 0, -1, 1), far_right(9, 5, -1, 2), behind(-1, 0, -1, -1);
    EXPECT_TRUE(beside(right, far_right, behind)) << "x - 2 w is 1, 5, 1";
    EXPECT_FALSE(beside(right, far_right, {-3, 0, -1, -1})) << "behind, to the left of where it would have to be: -1";
    EXPECT_FALSE(beside(right, far_right, {1.9f, 0, -1, 1}));
    EXPECT_FALSE(beside(right, far_right, {2, 0, -1, 1})) << "on the side";
    EXPECT_FALSE(beside(right, far_right, {2.000001f, 0, -1, 1})) << "by less than rounding";
    EXPECT_TRUE(beside({-3, 0, -1, 1}, {-9, 5, -1, 2}, {1, 0, -1, -1}));
    EXPECT_TRUE(beside({0, 3, -1, 1}, {0, 9, -1, 2}, {0, 0, -1, -1}));
    EXPECT_TRUE(beside({0, -3, -1, 1}, {0, -9, -1, 2}, {0, 0, -1, -1}));
    EXPECT_FALSE(beside({3, 0, -1, 1}, {-3, 0, -1, 1}, {0, 3, -1, 1})) << "beyond different sides";
    // At the end it comes in.
    const shared::CellTriangle moving{right, far_right, behind, right, far_right, {0, 0, -1, 1}};
    EXPECT_FALSE(shared::beside_image(moving, half, 1e-6f));
}

TEST(BesideImage, TouchesNoneOfIt) {
    constexpr float kHalf = 32.0f;
    const oracle::Box image{glm::dvec2(-kHalf), glm::dvec2(kHalf)};
    uint64_t beside = 0, elsewhere = 0;
    for (int i = 0; i < 300'000; ++i) {
        std::mt19937 random(static_cast<uint32_t>(i));
        const auto kind = static_cast<PrismKind>(i % oracle::kPrismKinds);
        std::uniform_real_distribution<double> corner(-3.0 * kHalf, 3.0 * kHalf);
        const double x = corner(random);
        const oracle::Prism p = oracle::make_prism(kind, false, glm::dvec2(x, corner(random)), random);
        const glm::vec4 d0 = p.end[0] - p.start[0], d1 = p.end[1] - p.start[1], d2 = p.end[2] - p.start[2];
        const shared::CellTriangle cell = shared::cell_triangle(p.start[0], p.start[1], p.start[2], d0, d1, d2, 0.0f, 1.0f);
        bool seen = false;
        for (int step = 0; step <= 16; ++step) seen = seen || orientation_in(exact(p), image, step / 16.0).has_value();
        const bool claimed = shared::beside_image(cell, glm::vec2(kHalf), 1e-6f);
        ASSERT_FALSE(seen && claimed) << oracle::name_of(kind) << ", case " << i;
        beside += claimed ? 1 : 0;
        elsewhere += seen ? 0 : 1;
    }
    std::cout << beside << " of " << elsewhere << " that are not seen" << std::endl;
    EXPECT_GT(beside, elsewhere / 2);
}

}  // namespace
}  // namespace gnomon::test
