// SPDX-License-Identifier: Apache-2.0
// The lights as the device knows them.
#pragma once

#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon {

/// The records of all lights, comp_shaders/shared/light.h; never empty.
std::vector<glm::vec4> light_records(const Scene& scene, const std::vector<Pose>& poses);

}  // namespace gnomon
