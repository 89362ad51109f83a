// SPDX-License-Identifier: Apache-2.0
// The judge of samples on cases worked out by hand.
#include "oracle/sample_judge.hpp"

#include <gtest/gtest.h>

#include "end_to_end/moving_triangles.hpp"

namespace gnomon::oracle {
namespace {

using Verdict = SampleJudge::Verdict;
constexpr uint32_t kMiss = SampleRecord::kMiss;

// Half planes x <= right at height z, seen from z = 8 by an image of 16 x 16 pixels over x, y from -1 to 1: pixel x shows (x -
// 8) / 8. The largest coordinate is 64, so that steps in space are 64 * 2^-18 = 2.4e-4 and the least tolerance is 7.6e-6.
test::Corners half_plane(float right, float z) { return {{{right, -60.0f, z}, {right, 60.0f, z}, {-64.0f, 0.0f, z}}}; }

test::MovingTriangles scene_of(const std::vector<std::pair<test::Corners, glm::vec3>>& triangles) {
    test::MovingTriangles scene(1);
    for (const auto& [corners, motion] : triangles) scene.add(corners, motion);
    Camera camera;
    camera.kind = CameraKind::orthographic;
    camera.ymag = 1.0;
    camera.znear = 1.0;
    scene.add(camera, {{{0.0, 0.0, 8.0}, {1.0, 0.0, 0.0, 0.0}}});
    scene.add(Light{}, {{{}, {1.0, 0.0, 0.0, 0.0}}});
    return scene;
}

Verdict primary(const test::MovingTriangles& scene, uint32_t triangle, const SamplePoint& sample) {
    return SampleJudge(scene.scene, scene.poses, 0, 16, 16).primary(triangle, sample);
}

Verdict shadow(const test::MovingTriangles& scene, bool lit, const SamplePoint& sample) {
    return SampleJudge(scene.scene, scene.poses, 0, 16, 16).shadow(0, 0, lit, sample);
}

TEST(SampleJudge, NearestTriangleIsRight) {
    // The upper one's edge moves from x = 0 to x = 0.5: in the image from 8 to 12.
    const test::MovingTriangles scene = scene_of({{half_plane(0.75f, 0.0f), {}}, {half_plane(0.0f, 1.0f), {0.5f, 0.0f, 0.0f}}});
    EXPECT_EQ(primary(scene, 1, {9.9, 8.0, 0.5}), Verdict::right);
    EXPECT_EQ(primary(scene, 0, {9.9, 8.0, 0.5}), Verdict::wrong);
    EXPECT_EQ(primary(scene, kMiss, {9.9, 8.0, 0.5}), Verdict::wrong);
    EXPECT_EQ(primary(scene, 0, {10.1, 8.0, 0.5}), Verdict::right);
    EXPECT_EQ(primary(scene, 1, {10.1, 8.0, 0.5}), Verdict::wrong);
    EXPECT_EQ(primary(scene, kMiss, {14.1, 8.0, 0.5}), Verdict::right);
    EXPECT_EQ(primary(scene, 0, {14.1, 8.0, 0.5}), Verdict::wrong);
}

TEST(SampleJudge, BordersAreAsWideAsStated) {
    const test::MovingTriangles scene = scene_of({{half_plane(0.0f, 0.0f), {}}});  // Its edge is at pixel 8; 2^-9 is 0.00195.
    EXPECT_EQ(primary(scene, kMiss, {8.0 - 0.0019, 8.0, 0.0}), Verdict::border);
    EXPECT_EQ(primary(scene, kMiss, {8.0 - 0.0021, 8.0, 0.0}), Verdict::wrong);
    EXPECT_EQ(primary(scene, 0, {8.0 + 0.0019, 8.0, 0.0}), Verdict::border);
    EXPECT_EQ(primary(scene, 0, {8.0 + 0.0021, 8.0, 0.0}), Verdict::wrong);
}

TEST(SampleJudge, EquallyDeepTrianglesTie) {
    // 8 * 2^-17 is 6.1e-5.
    for (const auto& [height, verdict] :
         {std::pair(0.0f, Verdict::right), std::pair(5e-5f, Verdict::tie), std::pair(8e-5f, Verdict::wrong)}) {
        const test::MovingTriangles scene = scene_of({{half_plane(0.75f, 0.0f), {}}, {half_plane(0.75f, height), {}}});
        EXPECT_EQ(primary(scene, 0, {8.0, 8.0, 0.0}), verdict);
        const SampleJudge judge(scene.scene, scene.poses, 0, 16, 16);
        EXPECT_EQ(judge.coincident(0, 1, {8.0, 8.0, 0.0}), verdict != Verdict::wrong);
        EXPECT_FALSE(judge.coincident(0, 1, {14.1, 8.0, 0.0}));
    }
}

TEST(SampleJudge, ShadowsFollowTheOccluder) {
    const test::MovingTriangles scene =
        scene_of({{half_plane(0.75f, 0.0f), {}}, {half_plane(0.0f, 20.0f), {0.5f, 0.0f, 0.0f}}});
    EXPECT_EQ(shadow(scene, false, {9.9, 8.0, 0.5}), Verdict::right);
    EXPECT_EQ(shadow(scene, true, {9.9, 8.0, 0.5}), Verdict::wrong);
    EXPECT_EQ(shadow(scene, true, {10.1, 8.0, 0.5}), Verdict::right);
    EXPECT_EQ(shadow(scene, false, {10.1, 8.0, 0.5}), Verdict::wrong);
    // 2.4e-4 is 0.00195 pixels.
    EXPECT_EQ(shadow(scene, true, {10.0 - 0.0019, 8.0, 0.5}), Verdict::border);
    EXPECT_EQ(shadow(scene, true, {10.0 - 0.0021, 8.0, 0.5}), Verdict::wrong);
}

TEST(SampleJudge, NearOccludersAreAMatterOfTolerance) {
    // The hit's largest coordinate is 0.5: its tolerance is 4.8e-7. The least is 7.6e-6; steps in space are 2.4e-4.
    const auto judged = [](float height, bool lit) {
        return shadow(scene_of({{half_plane(0.75f, 0.0f), {}}, {half_plane(0.75f, height), {}}}), lit, {12.0, 8.0, 0.0});
    };
    EXPECT_EQ(judged(4e-7f, true), Verdict::right);
    EXPECT_EQ(judged(4e-7f, false), Verdict::closer);
    EXPECT_EQ(judged(-4e-7f, false), Verdict::border);
    EXPECT_EQ(judged(6e-7f, false), Verdict::right);
    EXPECT_EQ(judged(6e-7f, true), Verdict::tolerance);
    EXPECT_EQ(judged(7e-6f, true), Verdict::tolerance);
    EXPECT_EQ(judged(9e-6f, true), Verdict::border);
    EXPECT_EQ(judged(3.5e-4f, true), Verdict::wrong);
}

}  // namespace
}  // namespace gnomon::oracle
