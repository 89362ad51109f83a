// SPDX-License-Identifier: Apache-2.0
// The rays of a camera and the places of lights, in float.
#include "view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::peer {

Motion::Motion(const std::vector<Rigid>& keys)
    : first_{glm::vec3(keys[0].translation), glm::mat3(glm::mat3_cast(keys[0].rotation))}, still_(true) {
    for (size_t k = 0; k + 1 < keys.size(); ++k) {
        const Rigid& a = keys[k];
        const Rigid& b = keys[k + 1];
        const glm::dquat last = glm::dot(a.rotation, b.rotation) < 0.0 ? -b.rotation : b.rotation;
        const double angle = 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(last - a.rotation)));
        // Too small a turn for float to see.
        const bool turns = angle > 1e-7;
        still_ = still_ && a.translation == b.translation && !turns;
        segments_.push_back({glm::vec3(a.translation), glm::vec3(b.translation - a.translation), glm::quat(a.rotation),
                             glm::quat(last), turns ? static_cast<float>(angle) : 0.0f,
                             static_cast<float>(1.0 / std::sin(angle))});
    }
}

Placement Motion::at(float t) const {
    if (still_) return first_;
    const KeyTime when = key_time(t, static_cast<uint32_t>(segments_.size()));
    const Segment& segment = segments_[when.segment];
    glm::quat rotation = segment.first;
    if (segment.angle > 0.0f) {
        rotation = glm::normalize(
            (segment.first * std::sin((1.0f - when.s) * segment.angle) + segment.last * std::sin(when.s * segment.angle)) *
            segment.per_sine);
    }
    return {segment.from + when.s * segment.step, glm::mat3_cast(rotation)};
}

View::View(const Camera& camera, Motion motion, glm::uvec2 size_px)
    : motion_(std::move(motion)),
      perspective_(camera.kind == CameraKind::perspective),
      centre_px_(0.5f * glm::vec2(size_px)),
      near_(static_cast<float>(camera.znear)),
      far_(camera.zfar > 0.0 ? static_cast<float>(camera.zfar) : std::numeric_limits<float>::infinity()) {
    const double half_height = perspective_ ? std::tan(0.5 * camera.yfov) : camera.ymag;
    const auto side = static_cast<float>(2.0 * half_height / size_px.y);
    per_px_ = {side, -side};
}

void View::aim(const float* x, const float* y, Rays& rays) const {
    Placement place = motion_.at(0.0f);
    const auto aim_one = [&](uint32_t i) {
        const float across = (x[i] - centre_px_.x) * per_px_.x, up = (y[i] - centre_px_.y) * per_px_.y;
        const glm::vec3 on_plane = place.rotation[0] * across + place.rotation[1] * up;
        const glm::vec3 origin = perspective_ ? place.translation : place.translation + on_plane;
        const glm::vec3 direction = perspective_ ? on_plane - place.rotation[2] : -place.rotation[2];
        rays.org_x[i] = origin.x;
        rays.org_y[i] = origin.y;
        rays.org_z[i] = origin.z;
        rays.dir_x[i] = direction.x;
        rays.dir_y[i] = direction.y;
        rays.dir_z[i] = direction.z;
        rays.tnear[i] = near_;
        rays.tfar[i] = far_;
    };
    if (motion_.still()) {
        for (uint32_t i = 0; i < rays.count; ++i) aim_one(i);
        return;
    }
    for (uint32_t i = 0; i < rays.count; ++i) {
        place = motion_.at(rays.time[i]);
        aim_one(i);
    }
}

}  // namespace gnomon::peer
