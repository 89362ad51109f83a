// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/cover.h: edges on bit patterns, coverage and depth against the oracle.
#include "math/cover.h"

#include <gtest/gtest.h>

#include <bit>

#include "oracle/prism_kinds.hpp"

namespace gnomon::test {
namespace {

using oracle::PrismKind;

float any_float(std::mt19937& random) {
    return std::ldexp(std::uniform_real_distribution<float>(-1.0f, 1.0f)(random), static_cast<int>(random() % 40) - 20);
}

// The sign bit flipped; of a zero either sign will do.
bool exact_negatives(float a, float b) {
    return std::bit_cast<uint32_t>(a) == (std::bit_cast<uint32_t>(b) ^ 0x80000000u) || (a == 0.0f && b == 0.0f);
}

TEST(Edges, SwappedEndsGiveExactNegatives) {
    std::mt19937 random(1);
    for (int i = 0; i < 1'000'000; ++i) {
        const float px = any_float(random), py = any_float(random), qx = any_float(random), qy = any_float(random);
        ASSERT_TRUE(exact_negatives(shared::edge_at_origin({px, py}, {qx, qy}), shared::edge_at_origin({qx, qy}, {px, py})));
    }
}

// Two triangles on either side of an edge, in every order of their vertices: the shared edge function is the same but for its
// sign, and no point on their common edge is missed by both. Points on vertices and on the edge included.
TEST(Edges, NeighboursLeaveNoCrack) {
    std::mt19937 random(2);
    for (int i = 0; i < 200'000; ++i) {
        const bool orthographic = i % 2 == 0;
        const oracle::Prism prism =
            oracle::make_prism(static_cast<PrismKind>(i % oracle::kPrismKinds), orthographic, glm::dvec2(0.0), random);
        const float s = std::uniform_real_distribution<float>(0.0f, 1.0f)(random);
        const auto at = [&](size_t v) { return shared::vertex_at(prism.start[v], prism.end[v] - prism.start[v], s); };
        const glm::vec4 p = at(0), q = at(1), left = at(2);
        const glm::vec4 right = p + q - left;
        const float x = i % 5 == 0 ? p.x / p.w : any_float(random), y = i % 5 == 0 ? p.y / p.w : any_float(random);
        const float along = shared::edges_at(left, p, q, x, y).x;
        ASSERT_TRUE(exact_negatives(along, shared::edges_at(right, q, p, x, y).x));
        ASSERT_TRUE(exact_negatives(along, shared::edges_at(q, p, right, x, y).z));
        ASSERT_TRUE(exact_negatives(along, shared::edges_at(p, right, q, x, y).y));
    }
}

TEST(Covers, ClosedTriangle) {
    const glm::vec4 p0(0, 0, 5, 1), p1(4, 0, 5, 1), p2(0, 4, 5, 1);
    for (const glm::vec2 inside :
         {glm::vec2(1, 1), glm::vec2(0, 0), glm::vec2(4, 0), glm::vec2(0, 4), glm::vec2(2, 0), glm::vec2(2, 2)}) {
        EXPECT_TRUE(shared::covers(shared::edges_at(p0, p1, p2, inside.x, inside.y)));
    }
    for (const glm::vec2 outside : {glm::vec2(-0.001f, 1), glm::vec2(2.001f, 2), glm::vec2(5, 0)}) {
        EXPECT_FALSE(shared::covers(shared::edges_at(p0, p1, p2, outside.x, outside.y)));
    }
    EXPECT_FALSE(shared::covers(shared::edges_at(p0, p2, p1, 1, 1))) << "the other orientation";
}

// Away from silhouettes the float test agrees with the oracle, and its depth to 1e-4 of the extent of the triangle's depths.
TEST(Covers, AgreesWithTheOracle) {
    std::mt19937 random(3);
    uint64_t seen = 0, differing = 0, wrong_depths = 0;
    for (int i = 0; i < 200'000; ++i) {
        const bool orthographic = i % 2 == 0;
        const PrismKind kind = i % 3 == 0 ? PrismKind::random : i % 3 == 1 ? PrismKind::turning : PrismKind::crossing_eye;
        const oracle::Prism prism = oracle::make_prism(kind, orthographic, glm::dvec2(0.0), random);
        const float s = std::uniform_real_distribution<float>(0.0f, 1.0f)(random);
        const float x = std::uniform_real_distribution<float>(0.0f, 1.0f)(random),
                    y = std::uniform_real_distribution<float>(0.0f, 1.0f)(random);
        const auto at = [&](size_t v) { return shared::vertex_at(prism.start[v], prism.end[v] - prism.start[v], s); };
        const std::optional<oracle::Surface> surface = surface_at(exact(prism), x, y, s);
        const size_t second = surface && !surface->positive ? 2 : 1;
        const glm::vec4 p0 = at(0), p1 = at(second), p2 = at(3 - second);
        const glm::vec3 e = shared::edges_at(p0, p1, p2, x, y);
        const float depth = orthographic ? shared::depth_orthographic(e, p0, p1, p2) : shared::depth_perspective(e, p0, p1, p2);
        const bool covered = shared::covers(e) && depth < (orthographic ? 3.4e38f : 0.0f);
        if (!surface) continue;
        ++seen;
        differing += covered ? 0 : 1;
        const double scale = orthographic ? 100.0 : std::abs(surface->depth);
        if (covered && std::abs(depth - surface->depth) > 1e-4 * scale) ++wrong_depths;
    }
    EXPECT_GT(seen, 20'000u);
    EXPECT_LT(differing, seen / 1000);
    EXPECT_LT(wrong_depths, seen / 1000);
}

}  // namespace
}  // namespace gnomon::test
