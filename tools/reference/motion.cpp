// SPDX-License-Identifier: Apache-2.0
// Where things are at a shutter time, in double.
#include "motion.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::reference {

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

SurfaceMotion::SurfaceMotion(const Scene& scene, const std::vector<Pose>& poses) : triangles_(scene.triangles) {
    for (const Pose& pose : poses) {
        keys_.push_back(posed_positions(scene, pose));
        keys_.back().emplace_back(0.0f);
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
