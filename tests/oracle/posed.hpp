// SPDX-License-Identifier: Apache-2.0
// The oracle of posing: morph targets, then skin, in double.
#pragma once

#include <gnomon/scene.hpp>

namespace gnomon::oracle {

/// World position of a vertex.
glm::dvec3 posed_position(const Scene& scene, const Pose& pose, size_t vertex);

}  // namespace gnomon::oracle
