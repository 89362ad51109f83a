// SPDX-License-Identifier: Apache-2.0
// How far prisms' ranges are from the true ones: motions whose answer is known.
#include "range_errors.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "end_to_end/moving_triangles.hpp"

namespace gnomon::test {
namespace {

/// In the view of a light straight above.
cli::RangeErrors errors_from_above(MovingTriangles& scene, uint32_t resolution) {
    Light light;
    light.kind = LightKind::directional;
    scene.add(light, {{glm::dvec3(0, 50, 0), glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0))}});
    return cli::range_errors(scene.scene, scene.poses,
                             light_faces(light, scene.poses, 0, bounds_of(scene.scene, scene.poses), resolution));
}

TEST(RangeErrorsTest, SpreadOfNumbers) {
    std::vector<float> numbers(101);
    std::iota(numbers.begin(), numbers.end(), 0.0f);
    const cli::Spread s = cli::spread_of(numbers);
    EXPECT_DOUBLE_EQ(s.mean, 50.0);
    EXPECT_DOUBLE_EQ(s.p99, 99.0);
    EXPECT_DOUBLE_EQ(s.most, 100.0);
    EXPECT_EQ(cli::spread_of({}).most, 0.0);
}

// Sides are planar and depth is linear in time: nothing differs.
TEST(RangeErrorsTest, TranslationsHaveNone) {
    MovingTriangles scene(2);
    scene.add({glm::vec3(0, 0, 0), {3, 1, 0}, {0, 2, 4}}, glm::vec3(5, 2, 1));
    const cli::RangeErrors e = errors_from_above(scene, 64);
    EXPECT_GT(e.pairs, 500u);
    EXPECT_EQ(e.missed + e.invented + e.several + e.left_over, 0u);
    EXPECT_GT(e.true_time, 0.0);
    EXPECT_LT(e.time_missed + e.time_invented, 1e-4 * e.true_time);
    EXPECT_LT(e.entry_time.most, 1e-4);
    EXPECT_LT(e.exit_time.most, 1e-4);
    EXPECT_LT(e.prism_depth.most, 1e-3);
    EXPECT_LT(e.linear_depth.most, 1e-3);
}

// Width x (1 + t), at rest in height: over the point x depth falls by g x / (1 + t), linear it is by g x (1 - t / 2). They
// differ most, of the times looked at, at t = 3 / 8: by 0.08523 g x. The widest place that is covered all the time is x = 10.
TEST(RangeErrorsTest, DepthOfWhatGrowsIsNotLinear) {
    constexpr float kSlope = 0.5f;
    MovingTriangles scene(1);
    scene.add({glm::vec3(-10, -10 * kSlope, -10), {10, 10 * kSlope, -10}, {0, 0, 20}},
              {glm::mat4(1.0f), glm::scale(glm::mat4(1.0f), glm::vec3(2, 1, 1))});
    const cli::RangeErrors e = errors_from_above(scene, 256);
    EXPECT_LE(e.linear_depth.most, 0.08523 * kSlope * 10.0 + 1e-3);
    EXPECT_GT(e.linear_depth.most, 0.08 * kSlope * 10.0);
    EXPECT_EQ(e.missed, 0u);
}

// A blade that turns by a right angle covers much that its triangulated sides do not hold, and the other way round.
TEST(RangeErrorsTest, TurningSidesAreNotPlanar) {
    MovingTriangles scene(1);
    scene.add({glm::vec3(0, 0, 0), {10, 0, 1}, {10, 0, 0}},
              {glm::mat4(1.0f), glm::rotate(glm::mat4(1.0f), glm::radians(90.0f), glm::vec3(0, 1, 0))});
    const cli::RangeErrors e = errors_from_above(scene, 128);
    EXPECT_GT(e.pairs, 1000u);
    EXPECT_GT(e.entry_time.most, 0.01);
    EXPECT_GT(e.time_missed, 0.01 * e.true_time);
    EXPECT_GT(e.time_invented, 0.01 * e.true_time);
}

}  // namespace
}  // namespace gnomon::test
