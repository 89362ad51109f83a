// SPDX-License-Identifier: Apache-2.0
// A scene as the options of a render want it.
#pragma once

#include "render_options.hpp"

namespace gnomon::cli {

struct PreparedScene {
    Scene scene;  ///< With what was added to it, which its warnings say.
    AnimationChoice animation;
    RenderSettings settings;  ///< The options' own, and the camera.

    std::vector<Pose> poses(const Shutter& shutter, uint32_t time_steps) const {
        return pose_scene(scene, animation, shutter.open, shutter.close, time_steps);
    }
};

/// Load the scene of the options, choose animation and camera, and add what the frames lack. Logs the scene's warnings.
PreparedScene prepare_scene(const RenderOptions& options, const std::vector<FrameJob>& frames);

}  // namespace gnomon::cli
