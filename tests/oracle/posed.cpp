// SPDX-License-Identifier: Apache-2.0
// The oracle of posing: whole matrices, blended before they are applied.
#include "oracle/posed.hpp"

namespace gnomon::oracle {

glm::dvec3 posed_position(const Scene& scene, const Pose& pose, size_t vertex_ix) {
    const Vertex& vertex = scene.vertices[vertex_ix];
    const Morph& morph = scene.morphs[vertex.morph];
    glm::dvec3 rest(vertex.position);
    for (size_t target = 0; target < morph.target_count; ++target) {
        const size_t delta = morph.delta_first + target * morph.vertex_count + vertex.morph_vertex;
        rest += double(pose.morph_weights[morph.weight_first + target]) * glm::dvec3(scene.morph_positions[delta]);
    }
    glm::dmat3x4 rows(0.0);
    for (size_t i = 0; i < vertex.influence_count; ++i) {
        const Influence& influence = scene.influences[vertex.influence_first + i];
        for (int row = 0; row < 3; ++row) {
            rows[row] +=
                double(influence.weight) * glm::dvec4(pose.palette[size_t(influence.matrix) * 3 + static_cast<size_t>(row)]);
        }
    }
    return glm::dvec4(rest, 1.0) * rows;
}

}  // namespace gnomon::oracle
