// SPDX-License-Identifier: Apache-2.0
// A scene whose S-buffers hold lists of lengths that layouts are apt to stumble over.
#pragma once

#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon::cli {

/// Stacks of small triangles over a ground, of 1, 2, ... 33, and around other powers of two, every second one moving; and one
/// of 20,000, or a map of many more texels.
struct CheckScene {
    CheckScene(const std::vector<LightKind>& lights, uint32_t segments, bool longest);

    Scene scene;
    std::vector<Pose> poses;
    RenderSettings settings;  ///< Few pixels; maps with partial tiles.
};

}  // namespace gnomon::cli
