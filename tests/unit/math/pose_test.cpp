// SPDX-License-Identifier: Apache-2.0
// comp_shaders/math/pose.h, through posed_positions, against the oracle; and the normals' transform.
#include "math/pose.h"

#include <gtest/gtest.h>

#include <random>

#include "oracle/posed.hpp"

namespace gnomon::test {
namespace {

TEST(Pose, PositionsAgreeWithTheOracle) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    const auto vector = [&] {
        const float x = normal(random), y = normal(random);
        return glm::vec3(x, y, normal(random));
    };
    constexpr uint32_t kVertices = 100, kTargets = 3, kMatrices = 7;
    Scene scene;
    scene.morphs = {Morph{}, Morph{kTargets, kVertices, 0, 1}};
    Pose pose;
    for (uint32_t i = 0; i < 1 + kTargets; ++i) pose.morph_weights.push_back(normal(random));
    for (uint32_t i = 0; i < 3 * kMatrices; ++i) pose.palette.emplace_back(vector(), normal(random));
    for (uint32_t i = 0; i < kTargets * kVertices; ++i) scene.morph_positions.push_back(vector());
    scene.morph_normals = scene.morph_positions;
    for (uint32_t v = 0; v < kVertices; ++v) {
        Vertex vertex;
        vertex.position = vector();
        vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
        vertex.influence_count = 1 + v % 5;
        for (uint32_t i = 0; i < vertex.influence_count; ++i) scene.influences.push_back({(v + i) % kMatrices, normal(random)});
        vertex.morph = v % 2;
        vertex.morph_vertex = v;
        scene.vertices.push_back(vertex);
    }
    const std::vector<glm::vec3> posed = posed_positions(scene, pose);
    ASSERT_EQ(posed.size(), kVertices);
    for (uint32_t v = 0; v < kVertices; ++v) {
        EXPECT_LT(glm::length(glm::dvec3(posed[v]) - oracle::posed_position(scene, pose, v)), 1e-4) << "vertex " << v;
    }
}

// Under (x, y, z) -> (2 x, y, z) the plane x + y = const becomes x / 2 + y = const: its normal (1, 1, 0) turns to (1, 2, 0) /
// sqrt 5.
TEST(Pose, NormalsGoWithTheInverseTranspose) {
    const glm::vec3 n = shared::skin_add_normal(glm::vec3(0.0f), {2, 0, 0, 9}, {0, 1, 0, 9}, {0, 0, 1, 9}, {1, 1, 0}, 0.5f);
    EXPECT_NEAR(n.x, 0.5 / std::sqrt(5.0), 1e-6);
    EXPECT_NEAR(n.y, 1.0 / std::sqrt(5.0), 1e-6);
    EXPECT_EQ(n.z, 0.0f);
    const glm::vec3 flat =
        shared::skin_add_normal(glm::vec3(1.0f), glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f), {1, 1, 0}, 1.0f);
    EXPECT_EQ(flat, glm::vec3(1.0f)) << "a matrix of rank 0 adds nothing";
}

}  // namespace
}  // namespace gnomon::test
