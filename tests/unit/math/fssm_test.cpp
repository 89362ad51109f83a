// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/fssm.h and footprint.h on numbers worked out by hand, and against the oracle on random ones.
#include "math/fssm.h"

#include <gmock/gmock.h>

#include <random>

#include "math/footprint.h"
#include "oracle/fssm.hpp"

namespace gnomon::test {
namespace {

const float kNone = shared::kFarthest;

glm::uvec2 set_of(const std::vector<int>& intervals) {
    glm::uvec2 set(0u);
    for (const int i : intervals) set = shared::with_interval(set, static_cast<uint32_t>(i));
    return set;
}

TEST(FssmLayers, IntervalsAreEqualParts) {
    EXPECT_EQ(shared::interval_of(2.0f, 2.0f, 66.0f), 0u);
    EXPECT_EQ(shared::interval_of(2.99f, 2.0f, 66.0f), 0u);
    EXPECT_EQ(shared::interval_of(3.0f, 2.0f, 66.0f), 1u);
    EXPECT_EQ(shared::interval_of(66.0f, 2.0f, 66.0f), 63u);
    EXPECT_EQ(shared::interval_of(5.0f, 5.0f, 5.0f), 0u);
    EXPECT_EQ(set_of({0, 31, 32, 63}), glm::uvec2(0x80000001u, 0x80000001u));
    EXPECT_TRUE(shared::has_interval(set_of({40}), 40));
    EXPECT_FALSE(shared::has_interval(set_of({40}), 8));
}

// Depths from 0 to 64, an interval a metre. Gaps: from 1 to 10, middle 5.5; from 11 to 31, 21; from 33 to 53, 43; from 54 to
// 63, 58.5.
TEST(FssmLayers, EndAtTheMiddleOfTheLongestGaps) {
    const glm::uvec2 set = set_of({0, 10, 31, 32, 53, 63});
    const float end = 64.5f;
    EXPECT_EQ(shared::split_layers(set, 0.0f, 64.0f, 1), glm::vec4(end, kNone, kNone, kNone));
    EXPECT_EQ(shared::split_layers(set, 0.0f, 64.0f, 2), glm::vec4(21.0f, end, kNone, kNone));
    EXPECT_EQ(shared::split_layers(set, 0.0f, 64.0f, 3), glm::vec4(21.0f, 43.0f, end, kNone));
    // Of the two gaps of 9 the nearer.
    EXPECT_EQ(shared::split_layers(set, 0.0f, 64.0f, 4), glm::vec4(5.5f, 21.0f, 43.0f, end));
    EXPECT_EQ(shared::split_layers(set_of({0, 1, 62, 63}), 0.0f, 64.0f, 4), glm::vec4(32.0f, end, kNone, kNone));
    // One depth only.
    EXPECT_EQ(shared::split_layers(set_of({0}), 7.0f, 7.0f, 4), glm::vec4(7.0f, kNone, kNone, kNone));
}

TEST(FssmLayers, HoldWhatIsBeforeTheirEnds) {
    const glm::vec4 ends(5.5f, 21.0f, 64.5f, kNone);
    EXPECT_EQ(shared::layer_count(ends), 3u);
    EXPECT_EQ(shared::layer_of(0.5f, ends), 0u);
    EXPECT_EQ(shared::layer_of(10.0f, ends), 1u);
    EXPECT_EQ(shared::layer_of(64.0f, ends), 2u);
    EXPECT_EQ(shared::layer_of(kNone, ends), 3u);
    EXPECT_EQ(shared::layer_count(glm::vec4(kNone)), 0u);
}

TEST(FssmLayers, AreTheOracles) {
    std::mt19937 random(8);
    for (int i = 0; i < 2000; ++i) {
        std::vector<int> occupied = {0};
        const double density = 0.02 + 0.3 * (i % 10) / 10.0;
        for (int k = 1; k < 63; ++k) {
            if (std::bernoulli_distribution(density)(random)) occupied.push_back(k);
        }
        occupied.push_back(63);
        for (int most = 1; most <= 4; ++most) {
            const glm::vec4 ends = shared::split_layers(set_of(occupied), 3.0f, 35.0f, static_cast<uint32_t>(most));
            const std::vector<int> starts = oracle::layer_starts(occupied, most);
            ASSERT_EQ(shared::layer_count(ends), starts.size() + 1);
            for (const int k : occupied) {
                const auto expected = std::upper_bound(starts.begin(), starts.end(), k) - starts.begin();
                // The nearest and the farthest depth of the interval.
                ASSERT_EQ(shared::layer_of(3.0f + 0.5f * float(k), ends), static_cast<uint32_t>(expected));
                ASSERT_EQ(shared::layer_of(3.0f + 0.5f * float(k + 1), ends), static_cast<uint32_t>(expected));
            }
        }
    }
}

TEST(FssmGrid, DepthMovesToTheMiddle) {
    EXPECT_FLOAT_EQ(shared::depth_at_middle(10.0f, 4.0f, 0.25f), 11.0f);
    EXPECT_FLOAT_EQ(shared::depth_at_middle(10.0f, 4.0f, 1.0f), 8.0f);
}

// |d| = 4, f = 12, o = 8: s_u = 8 / 16, s_v = 8 / 12; u along -y, v along x.
TEST(FssmGrid, TurnsAndStretches) {
    const shared::LayerGrid grid = shared::layer_grid(glm::vec2(0.0f, -4.0f), 12.0f, 8.0f);
    EXPECT_FLOAT_EQ(grid.motion, 4.0f);
    EXPECT_EQ(grid.scale, glm::vec2(0.5f, 8.0f / 12.0f));
    // Three texels along the motion, at t = 1/4: one more by t = 1/2.
    const glm::vec2 p = shared::grid_point(grid, glm::vec2(1.5f, -3.0f), 0.25f, 8.0f);
    EXPECT_FLOAT_EQ(p.x, 4.0f + 0.5f * 4.0f);
    EXPECT_FLOAT_EQ(p.y, 4.0f + 1.0f);
    // The guard band's end, at the shutter's: the grid's (section 4.1, M d).
    EXPECT_FLOAT_EQ(shared::grid_point(grid, glm::vec2(0.0f, -6.0f), 0.0f, 8.0f).x, 8.0f);
    EXPECT_FLOAT_EQ(shared::grid_point(grid, glm::vec2(0.0f, 6.0f), 1.0f, 8.0f).x, 0.0f);
    const shared::LayerGrid still = shared::layer_grid(glm::vec2(0.0f), 16.0f, 16.0f);
    EXPECT_EQ(shared::grid_point(still, glm::vec2(2.5f, -1.0f), 0.9f, 16.0f), glm::vec2(10.5f, 7.0f));
    EXPECT_EQ(shared::clamp_to_grid(glm::vec2(-3.0f, 15.9f), 16.0f), glm::vec2(0.5f, 15.5f));
}

TEST(FssmLight, IsBoundedByTheVariance) {
    // Depths 1 and 3 of four samples: mean 2, variance 1, opacity 1/2. At 4: 1 - (1 - 1/5) / 2.
    EXPECT_FLOAT_EQ(shared::layer_visibility(glm::vec4(4.0f, 10.0f, 2.0f, 4.0f), 4.0f), 0.6f);
    EXPECT_FLOAT_EQ(shared::layer_visibility(glm::vec4(4.0f, 10.0f, 2.0f, 4.0f), 2.0f), 1.0f);
    EXPECT_FLOAT_EQ(shared::layer_visibility(glm::vec4(6.0f, 18.0f, 2.0f, 2.0f), 4.0f), 0.0f);
    EXPECT_FLOAT_EQ(shared::layer_visibility(glm::vec4(0.0f, 0.0f, 0.0f, 3.0f), 4.0f), 1.0f);
    EXPECT_FLOAT_EQ(shared::layer_visibility(glm::vec4(0.0f), 4.0f), 1.0f);
}

TEST(FssmFilter, TentGrowsWithTheMotion) {
    EXPECT_FLOAT_EQ(shared::tent_reach(2.0f, 16.0f), 0.0f);
    EXPECT_FLOAT_EQ(shared::tent_reach(42.0f, 16.0f), 1.0f);  // 0.05 * 40 wide.
    EXPECT_FLOAT_EQ(shared::tent_reach(1000.0f, 16.0f), 8.0f);
}

TEST(FssmFilter, NeighboursAreChosenUpToHalfTheTime) {
    EXPECT_EQ(shared::neighbour_chance(0.0f), 0.0f);
    EXPECT_EQ(shared::neighbour_chance(-1.0f / 3.0f), 0.0f);
    EXPECT_NEAR(shared::neighbour_chance(5.0f / 12.0f), 0.25f, 1e-6f);
    EXPECT_NEAR(shared::neighbour_chance(-0.5f), 0.5f, 1e-6f);
    EXPECT_EQ(shared::choose_neighbour(0.5f, 0.49f), 1.0f);
    EXPECT_EQ(shared::choose_neighbour(-0.5f, 0.49f), -1.0f);
    EXPECT_EQ(shared::choose_neighbour(-0.5f, 0.51f), 0.0f);
    EXPECT_EQ(shared::choose_neighbour(0.1f, 0.0f), 0.0f);
}

shared::ViewRows rows(const glm::mat3& by_row, glm::vec3 constants, glm::vec3 origin) {
    shared::ViewRows r{};
    for (glm::length_t i = 0; i < 3; ++i) r.row[i] = glm::vec4(by_row[i], constants[i]);
    r.origin = origin;
    return r;
}

// A view that looks along -z and moves by 2 along x: a point before it moves with it.
TEST(FssmFootprint, FollowsTheCamera) {
    const glm::mat3 axes(glm::vec3(10, 0, 0), glm::vec3(0, -10, 0), glm::vec3(0, 0, -1));
    const shared::ViewRows a = rows(axes, glm::vec3(0.0f), glm::vec3(0, 0, 5)),
                           b = rows(axes, glm::vec3(0.0f), glm::vec3(2, 0, 5));
    const glm::vec3 p(1, 1, 1);
    const shared::ViewNear at_start = shared::view_near(a, b, 0.0f, p), later = shared::view_near(a, b, 0.25f, p);
    EXPECT_EQ(at_start.value, glm::vec3(10, -10, 4));
    EXPECT_EQ(later.value, glm::vec3(5, -10, 4));
    EXPECT_EQ(shared::seen_at(later, glm::vec3(0.1f, 0, 0)), glm::vec3(6, -10, 4));
    const glm::vec3 offset = shared::offset_of(later, at_start.value);
    EXPECT_NEAR(offset.x, 0.5f, 1e-6f);
    EXPECT_NEAR(offset.y, 0.0f, 1e-6f);
    EXPECT_NEAR(offset.z, 0.0f, 1e-6f);
}

// Of any two views, the point found is seen where it should be.
TEST(FssmFootprint, InvertsAnyView) {
    std::mt19937 random(4);
    std::normal_distribution<float> normal;
    const auto vector = [&] { return glm::vec3(normal(random), normal(random), normal(random)); };
    for (int i = 0; i < 1000; ++i) {
        const shared::ViewRows a = rows(glm::mat3(vector(), vector(), vector()), vector(), vector());
        const shared::ViewNear near = shared::view_near(a, a, 0.7f, vector());
        const float determinant = glm::determinant(glm::mat3(near.change[0], near.change[1], near.change[2]));
        if (std::abs(determinant) < 0.05f) continue;
        const glm::vec3 wanted = vector(), found = shared::seen_at(near, shared::offset_of(near, wanted));
        ASSERT_LT(glm::length(found - wanted), 1e-3f);
    }
}

}  // namespace
}  // namespace gnomon::test
