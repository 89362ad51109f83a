// SPDX-License-Identifier: Apache-2.0
// The oracles of moving triangles and of prefix sums against numbers worked out by hand.
#include "oracle/moving_triangle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "oracle/polynomial.hpp"
#include "oracle/prefix_sum.hpp"

namespace gnomon::oracle {
namespace {

constexpr double kTiny = 1e-12;

std::array<glm::dvec4, 3> flat(glm::dvec2 p, glm::dvec2 q, glm::dvec2 r, double z) {
    return {glm::dvec4(p, z, 1.0), glm::dvec4(q, z, 1.0), glm::dvec4(r, z, 1.0)};
}

std::array<glm::dvec4, 3> deep(glm::dvec2 p, glm::dvec2 q, glm::dvec2 r, double w) {
    return {glm::dvec4(p, -1.0, w), glm::dvec4(q, -1.0, w), glm::dvec4(r, -1.0, w)};
}

// Right-angled at (0, 0), legs of 4 along x and y, 5 deep; moves 8 to the right.
const MovingTriangle kSlider = {flat({0, 0}, {4, 0}, {0, 4}, 5.0), flat({8, 0}, {12, 0}, {8, 4}, 5.0)};

void expect_stay(const Stay& stay, double enter, double leave, bool positive) {
    EXPECT_NEAR(stay.enter, enter, kTiny);
    EXPECT_NEAR(stay.leave, leave, kTiny);
    EXPECT_EQ(stay.positive, positive);
}

TEST(Polynomial, FindsTheRootsOfACubic) {
    // (t - 1/4)(t - 1/2)(t - 2) = t^3 - 2.75 t^2 + 1.625 t - 0.25; the root 2 lies outside.
    const std::vector<long double> roots = Polynomial({-0.25L, 1.625L, -2.75L, 1.0L}).sign_changes();
    ASSERT_EQ(roots.size(), 2u);
    EXPECT_NEAR(static_cast<double>(roots[0]), 0.25, kTiny);
    EXPECT_NEAR(static_cast<double>(roots[1]), 0.5, kTiny);
}

// At (6, 1) the triangle's own x is 6 - 8 s. It covers where that is from 0 to 3: s from 3/8 to 6/8.
TEST(StaysAt, TranslationEntersAndLeavesOnce) {
    const std::vector<Stay> stays = stays_at(kSlider, 6.0, 1.0);
    ASSERT_EQ(stays.size(), 1u);
    expect_stay(stays[0], 0.375, 0.75, true);
    EXPECT_TRUE(stays_at(kSlider, 6.0, 4.5).empty());
}

// (x, y) of the vertices stay, w goes from 2 to 4. The long side is x + y = 4, in the image X + Y = 4 / w: (0.75, 0.75) is
// inside while w <= 8/3, s <= 1/3.
TEST(StaysAt, RecedingTriangleShrinks) {
    const MovingTriangle t = {deep({-2, -2}, {6, -2}, {-2, 6}, 2.0), deep({-2, -2}, {6, -2}, {-2, 6}, 4.0)};
    const std::vector<Stay> stays = stays_at(t, 0.75, 0.75);
    ASSERT_EQ(stays.size(), 1u);
    expect_stay(stays[0], 0.0, 1.0 / 3.0, true);
}

// The base from (-4, -4) to (4, -4) turns round, the apex (0, 4) stays. At y = 0 half the width is 2 |1 - 2 s|: x = 1 is inside
// until 1/4 and from 3/4 on.
TEST(StaysAt, TurningTriangleIsSeenFromBothSides) {
    const MovingTriangle t = {flat({-4, -4}, {4, -4}, {0, 4}, 1.0), flat({4, -4}, {-4, -4}, {0, 4}, 1.0)};
    const std::vector<Stay> stays = stays_at(t, 1.0, 0.0);
    ASSERT_EQ(stays.size(), 2u);
    expect_stay(stays[0], 0.0, 0.25, true);
    expect_stay(stays[1], 0.75, 1.0, false);
}

// w goes from -1 to 3 and is positive from s = 1/4 on; the axis always passes through the triangle.
TEST(StaysAt, TriangleComesFromBehind) {
    const MovingTriangle t = {deep({-8, -8}, {8, -8}, {0, 8}, -1.0), deep({-8, -8}, {8, -8}, {0, 8}, 3.0)};
    const std::vector<Stay> stays = stays_at(t, 0.0, 0.0);
    ASSERT_EQ(stays.size(), 1u);
    expect_stay(stays[0], 0.25, 1.0, true);
}

TEST(StaysAt, NoAreaIsNeverSeen) {
    const MovingTriangle line = {flat({0, 0}, {2, 2}, {4, 4}, 1.0), flat({1, 1}, {3, 3}, {5, 5}, 1.0)};
    EXPECT_TRUE(stays_at(line, 2.0, 2.0).empty());
    const MovingTriangle point = {flat({1, 1}, {1, 1}, {1, 1}, 1.0), flat({1, 1}, {1, 1}, {1, 1}, 1.0)};
    EXPECT_TRUE(stays_at(point, 1.0, 1.0).empty());
}

// Vertices at w = 1, 2, 4 on X = 0, 1, 0 and Y = 0, 0, 1 of the image. The plane's 1 / w is linear in the image: 1 - X / 2 - 3
// Y / 4, at (1/4, 1/4) 11/16.
TEST(SurfaceAt, DepthIsPerspectivelyRight) {
    const std::array<glm::dvec4, 3> v = {glm::dvec4(0, 0, -1, 1), glm::dvec4(2, 0, -1, 2), glm::dvec4(0, 4, -1, 4)};
    const std::optional<Surface> surface = surface_at({v, v}, 0.25, 0.25, 0.3);
    ASSERT_TRUE(surface);
    EXPECT_NEAR(surface->depth, -11.0 / 16.0, kTiny);
    EXPECT_TRUE(surface->positive);
    // Half, a quarter and a quarter in the image; on the triangle these over 1, 2 and 4.
    EXPECT_NEAR(glm::length(surface->barycentrics - glm::dvec3(8.0, 2.0, 1.0) / 11.0), 0.0, kTiny);
}

// z = 1, 3, 7 at (0, 0), (4, 0), (0, 4): z = 1 + x / 2 + 3 y / 2. At s = 1/2 the slider's corner is at (4, 0); (5, 2) is (1, 2)
// of its own.
TEST(SurfaceAt, OrthographicDepthIsLinear) {
    MovingTriangle t = kSlider;
    for (auto* key : {&t.start, &t.end}) {
        (*key)[0].z = 1.0;
        (*key)[1].z = 3.0;
        (*key)[2].z = 7.0;
    }
    EXPECT_NEAR(surface_at(t, 5.0, 2.0, 0.5)->depth, 4.5, kTiny);
    EXPECT_NEAR(glm::length(surface_at(t, 5.0, 2.0, 0.5)->barycentrics - glm::dvec3(0.25, 0.25, 0.5)), 0.0, kTiny);
    std::swap(t.start[1], t.start[2]);
    std::swap(t.end[1], t.end[2]);
    EXPECT_FALSE(surface_at(t, 5.0, 2.0, 0.5)->positive);
}

// At s = 1/2 the slider's corners are (4, 0), (8, 0) and (4, 4).
TEST(OrientationIn, TouchesWhatItOverlaps) {
    EXPECT_EQ(orientation_in(kSlider, {{5, 1}, {6, 2}}, 0.5), std::optional(true));      // Inside.
    EXPECT_EQ(orientation_in(kSlider, {{0, -9}, {20, 20}}, 0.5), std::optional(true));   // All around.
    EXPECT_EQ(orientation_in(kSlider, {{5.9, 1.9}, {7, 3}}, 0.5), std::optional(true));  // The long side cuts off a corner.
    EXPECT_EQ(orientation_in(kSlider, {{6.1, 2.1}, {7, 3}}, 0.5), std::nullopt);         // Just beyond the long side.
    EXPECT_EQ(orientation_in(kSlider, {{2, 0}, {4, 4}}, 0.5), std::nullopt);             // Side by side.
    EXPECT_EQ(orientation_in(kSlider, {{2, 0}, {4, 4}}, 0.25), std::optional(true));     // Earlier.
    const MovingTriangle behind = {deep({-8, -8}, {8, -8}, {0, 8}, -1.0), deep({-8, -8}, {8, -8}, {0, 8}, 3.0)};
    EXPECT_EQ(orientation_in(behind, {{-1, -1}, {1, 1}}, 0.2), std::nullopt);
    EXPECT_EQ(orientation_in(behind, {{-1, -1}, {1, 1}}, 0.3), std::optional(true));
}

TEST(SeenAt, NearestFirstThenLowestIndex) {
    const MovingTriangle near = {flat({-9, -9}, {9, -9}, {0, 9}, 2.0), flat({-9, -9}, {9, -9}, {0, 9}, 2.0)};
    MovingTriangle far = near;
    for (auto& v : far.start) v.z = 6.0;
    for (auto& v : far.end) v.z = 4.0;
    std::vector<uint32_t> order;
    for (const Seen& seen : seen_at({far, near, near}, 0.0, 0.0, 0.5, 0.0, 100.0)) order.push_back(seen.triangle);
    EXPECT_THAT(order, testing::ElementsAre(1u, 2u, 0u));
    EXPECT_EQ(seen_at({far, near, near}, 0.0, 0.0, 0.5, 2.0, 100.0).size(), 1u);
    EXPECT_EQ(seen_at({far, near, near}, 0.0, 0.0, 0.5, 0.0, 5.0).size(), 2u);
}

TEST(ExclusiveSums, TotalGoesBehind) {
    EXPECT_THAT(exclusive_sums({3, 1, 2}), testing::ElementsAre(0u, 3u, 4u, 6u));
    EXPECT_THAT(exclusive_sums({}), testing::ElementsAre(0u));
    EXPECT_EQ(exclusive_sums({0xffffffffu, 2u}).back(), 0x100000001ull);
}

}  // namespace
}  // namespace gnomon::oracle
