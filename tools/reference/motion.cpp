// SPDX-License-Identifier: Apache-2.0
// Where things are at a shutter time, in double.
#include "motion.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "math/pose.h"

namespace gnomon::reference {
namespace {

// As long as the influences agree on it: of unit length for a rigid vertex.
glm::vec3 posed_normal(const Scene& scene, const Pose& pose, const Vertex& vertex) {
    const Morph& morph = scene.morphs[vertex.morph];
    glm::vec3 rest = vertex.normal;
    for (uint32_t j = 0; j < morph.target_count; ++j) {
        const uint32_t delta = morph.delta_first + j * morph.vertex_count + vertex.morph_vertex;
        rest = shared::morph_add(rest, scene.morph_normals[delta], pose.morph_weights[morph.weight_first + j]);
    }
    glm::vec3 sum(0.0f);
    for (uint32_t i = 0; i < vertex.influence_count; ++i) {
        const Influence& influence = scene.influences[vertex.influence_first + i];
        const glm::vec4* rows = &pose.palette[influence.matrix * 3];
        sum = shared::skin_add_normal(sum, rows[0], rows[1], rows[2], rest, influence.weight);
    }
    return sum;
}

}  // namespace

std::vector<glm::vec3> posed_normals(const Scene& scene, const Pose& pose) {
    std::vector<glm::vec3> normals;
    normals.reserve(scene.vertices.size());
    for (const Vertex& vertex : scene.vertices) normals.push_back(posed_normal(scene, pose, vertex));
    return normals;
}

RigidMotion::RigidMotion(const std::vector<Rigid>& keys) {
    for (size_t k = 0; k + 1 < keys.size(); ++k) {
        const Rigid& a = keys[k];
        const Rigid& b = keys[k + 1];
        const glm::dquat last = glm::dot(a.rotation, b.rotation) < 0.0 ? -b.rotation : b.rotation;
        // Half the chord is the sine of half the angle; unlike the arc cosine of a dot product this is accurate near zero.
        const double angle = 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(last - a.rotation)));
        segments_.push_back(
            {a.translation, b.translation - a.translation, a.rotation, last, glm::mat3_cast(a.rotation), angle});
    }
}

RigidMotion::Placement RigidMotion::at(KeyTime when) const {
    const Segment& segment = segments_[when.segment];
    Placement placement{segment.from + when.s * segment.step, segment.first_rotation};
    if (segment.angle > 0.0) {
        const double first = std::sin((1.0 - when.s) * segment.angle);
        const double last = std::sin(when.s * segment.angle);
        placement.rotation = glm::mat3_cast(glm::normalize(segment.first * first + segment.last * last));
    }
    return placement;
}

SurfaceMotion::SurfaceMotion(const Scene& scene, const std::vector<Pose>& poses)
    : triangles_(scene.triangles), keys_(poses.size()) {
    std::vector<std::jthread> threads;
    for (size_t k = 0; k < poses.size(); ++k) {
        threads.emplace_back([&, k] {
            keys_[k] = posed_positions(scene, poses[k]);
            keys_[k].emplace_back(0.0f);
        });
    }
}

std::array<glm::dvec3, 3> SurfaceMotion::corners(uint32_t triangle, KeyTime when) const {
    const std::vector<glm::vec3>& first = keys_[when.segment];
    const std::vector<glm::vec3>& last = keys_[when.segment + 1];
    std::array<glm::dvec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
        const uint32_t vertex = triangles_[triangle].vertex[i];
        const glm::dvec3 a(first[vertex]);
        corners[i] = a + when.s * (glm::dvec3(last[vertex]) - a);
    }
    return corners;
}

}  // namespace gnomon::reference
