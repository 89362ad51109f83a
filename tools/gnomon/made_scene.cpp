// SPDX-License-Identifier: Apache-2.0
#include "made_scene.hpp"

#include <cmath>

namespace gnomon::cli {

void add_triangle(Scene& scene, const glm::dvec3 (&corners)[3], uint32_t matrix) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    for (const glm::dvec3& corner : corners) {
        Vertex vertex;
        vertex.position = corner;
        vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
        vertex.influence_count = 1;
        scene.influences.push_back({matrix, 1.0f});
        scene.vertices.push_back(vertex);
    }
    scene.triangles.push_back({{first, first + 1, first + 2}, 0});
}

Rigid looking_down(const glm::dvec3& from, double aside) {
    const double angle = -0.5 * std::acos(-1.0) + aside;
    return {from, glm::angleAxis(angle, glm::dvec3(1.0, 0.0, 0.0))};
}

}  // namespace gnomon::cli
