// SPDX-License-Identifier: Apache-2.0
// What tests of made scenes ask of them.
#pragma once

#include <gnomon/scene.hpp>
#include <scenes/scene_makers.hpp>
#include <string>
#include <vector>

namespace gnomon::makers {

inline constexpr AnimationChoice kFirstAnimation{AnimationChoice::Kind::one, 0};

std::vector<Triangle> triangles_of(const Scene& scene, const std::string& material);

/// Each once.
std::vector<uint32_t> vertices_of(const Scene& scene, const std::string& material);

/// Every edge belongs to two triangles that run along it in opposite directions, and the inside has a positive volume. Vertices
/// at one place that move together are one.
void expect_closed(const Scene& scene, const std::string& material);

/// When the default shutter opens and when it closes.
std::vector<Pose> default_shutter(const Scene& scene);

/// The motion of each of the vertices in the default shutter, metres.
std::vector<glm::dvec3> motions(const Scene& scene, const std::vector<uint32_t>& vertices);

/// How far each vertex of the material moves in the default shutter, metres.
std::vector<double> displacements(const Scene& scene, const std::string& material);

double largest(const std::vector<double>& values);
glm::dvec3 mean(const std::vector<glm::dvec3>& values);

}  // namespace gnomon::makers
