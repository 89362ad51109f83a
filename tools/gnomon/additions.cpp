// SPDX-License-Identifier: Apache-2.0
// What a render adds to a scene that lacks a camera or a light, or for which a ground was asked.
#include "additions.hpp"

#include <algorithm>

namespace gnomon::cli {

namespace {

// Poses that the default camera of a sequence takes into account: enough for every frame of a short one, bounded for a long
// one.
constexpr uint64_t kMaxFramedSegments = 256;

// Half sides of the ground, in horizontal radii of the scene: far enough for shadows of a low light.
constexpr float kGroundRadii = 6.0f;

}  // namespace

Additions::Additions(const Scene& scene, const AnimationChoice& animation, const RenderOptions& options,
                     const std::vector<FrameJob>& frames)
    : light_(scene.lights.empty()),
      aspect_(static_cast<double>(options.settings.width) / static_cast<double>(options.settings.height)) {
    const auto bounds_over = [&](const Shutter& shutter, uint64_t segments) {
        return bounds_of(scene, pose_scene(scene, animation, shutter.open, shutter.close, static_cast<uint32_t>(segments)));
    };
    if (scene.cameras.empty()) {
        const uint64_t segments = std::min(uint64_t{options.time_steps} * frames.size(), kMaxFramedSegments);
        framed_ = bounds_over({frames.front().shutter.open, frames.back().shutter.close},
                              std::max<uint64_t>(segments, options.time_steps));
    }
    if (options.ground) {
        const Bounds bounds = bounds_over(frames.front().shutter, options.time_steps);
        const glm::vec2 lower(bounds.lower.x, bounds.lower.z);
        const glm::vec2 upper(bounds.upper.x, bounds.upper.z);
        ground_ = Ground{0.5f * (lower + upper), options.ground->height.value_or(bounds.lower.y),
                         kGroundRadii * 0.5f * glm::length(upper - lower)};
    }
}

Scene Additions::apply(Scene scene) const {
    std::vector<Pose> poses;  // They are of the rig, too.
    if (framed_) add_default_camera(scene, poses, *framed_, aspect_);
    if (light_) add_default_light(scene, poses);
    if (ground_) add_ground(scene, poses, ground_->center_xz, ground_->y, ground_->half_size);
    return scene;
}

}  // namespace gnomon::cli
