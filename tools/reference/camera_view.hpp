// SPDX-License-Identifier: Apache-2.0
// The rays of a moving camera.
#pragma once

#include "motion.hpp"

namespace gnomon::reference {

struct CameraRay {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< Of length 1 along the view axis: the distance along the ray is the depth.
};

class CameraView {
public:
    /// The vertical extent is the camera's, the horizontal one follows from the image's aspect.
    CameraView(const Camera& camera, RigidMotion motion, glm::uvec2 image_size_px);

    /// point_px: in the image, x to the right, y down.
    CameraRay ray(glm::dvec2 point_px, KeyTime when) const;

    double near_depth() const { return near_depth_; }
    double far_depth() const { return far_depth_; }  ///< May be infinite.

private:
    RigidMotion motion_;
    CameraKind kind_;
    glm::dvec2 image_size_px_;
    glm::dvec2 half_extent_;  ///< Of the image, at depth 1 in perspective.
    double near_depth_, far_depth_;
};

}  // namespace gnomon::reference
