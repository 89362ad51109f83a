// SPDX-License-Identifier: Apache-2.0
// What a render adds to a scene that lacks a camera or a light, or for which a ground was asked.
#pragma once

#include <gnomon/scene.hpp>
#include <optional>
#include <vector>

#include "render_options.hpp"

namespace gnomon::cli {

/// Decided once for all frames of a sequence, so that nothing jumps between them.
class Additions {
public:
    /// Errors: ErrorKind::input where the scene has nothing that a camera could frame or that a ground could lie below.
    Additions(const Scene& scene, const AnimationChoice& animation, const RenderOptions& options,
              const std::vector<FrameJob>& frames);

    bool empty() const { return !framed_ && !light_ && !ground_; }

    /// The scene with them, which do not move; its warnings then say what was added.
    Scene apply(Scene scene) const;

private:
    struct Ground {
        glm::vec2 center_xz;
        float y;
        float half_size;
    };

    std::optional<Bounds> framed_;  // What the default camera frames.
    bool light_ = false;
    std::optional<Ground> ground_;
    double aspect_ = 1.0;
};

}  // namespace gnomon::cli
