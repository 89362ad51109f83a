// SPDX-License-Identifier: Apache-2.0
// The rays of a moving camera.
#include "camera_view.hpp"

#include <cmath>
#include <limits>

namespace gnomon::reference {

CameraView::CameraView(const Camera& camera, RigidMotion motion, glm::uvec2 image_size_px)
    : motion_(std::move(motion)),
      kind_(camera.kind),
      image_size_px_(image_size_px),
      near_depth_(camera.znear),
      far_depth_(camera.zfar > 0.0 ? camera.zfar : std::numeric_limits<double>::infinity()) {
    const double half_height = kind_ == CameraKind::perspective ? std::tan(0.5 * camera.yfov) : camera.ymag;
    half_extent_ = {half_height * image_size_px_.x / image_size_px_.y, half_height};
}

CameraRay CameraView::ray(glm::dvec2 point_px, KeyTime when) const {
    const glm::dvec2 ndc(2.0 * point_px.x / image_size_px_.x - 1.0, 1.0 - 2.0 * point_px.y / image_size_px_.y);
    const glm::dvec2 on_plane = ndc * half_extent_;
    const RigidMotion::Placement placement = motion_.at(when);
    if (kind_ == CameraKind::perspective) {
        return {placement.translation, placement.rotation * glm::dvec3(on_plane, -1.0)};
    }
    return {placement.translation + placement.rotation * glm::dvec3(on_plane, 0.0), -placement.rotation[2]};
}

}  // namespace gnomon::reference
