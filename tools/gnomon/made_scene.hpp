// SPDX-License-Identifier: Apache-2.0
// Scenes that are made in memory, triangle by triangle.
#pragma once

#include <gnomon/scene.hpp>

namespace gnomon::cli {

/// Of three vertices of its own, metres before they are posed, that move with a matrix of the palette; of the first material.
void add_triangle(Scene& scene, const glm::dvec3 (&corners)[3], uint32_t matrix);

/// Looking down, turned by so many radians about X, from a place.
Rigid looking_down(const glm::dvec3& from, double aside);

}  // namespace gnomon::cli
