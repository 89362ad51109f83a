// SPDX-License-Identifier: Apache-2.0
// The oracle of posing against numbers worked out by hand.
#include "oracle/posed.hpp"

#include <gtest/gtest.h>

namespace gnomon::oracle {
namespace {

// (1, 2, 3) + 0.5 * (2, 0, 0) = (2, 2, 3). Matrix 0 moves by (10, 0, 0): (12, 2, 3). Matrix 1 swaps x and y: (2, 2, 3).
// A quarter of the first and three quarters of the second: (4.5, 2, 3).
TEST(PosedPosition, MorphsThenBlends) {
    Scene scene;
    scene.morphs = {Morph{}, Morph{1, 1, 0, 0}};
    scene.morph_positions = {glm::vec3(2, 0, 0)};
    scene.influences = {{0, 0.25f}, {1, 0.75f}};
    Vertex vertex;
    vertex.position = glm::vec3(1, 2, 3);
    vertex.influence_count = 2;
    vertex.morph = 1;
    scene.vertices = {vertex};
    Pose pose;
    pose.palette = {{1, 0, 0, 10}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}};
    pose.morph_weights = {0.5f};
    const glm::dvec3 p = posed_position(scene, pose, 0);
    EXPECT_DOUBLE_EQ(p.x, 4.5);
    EXPECT_DOUBLE_EQ(p.y, 2.0);
    EXPECT_DOUBLE_EQ(p.z, 3.0);
}

}  // namespace
}  // namespace gnomon::oracle
