// SPDX-License-Identifier: Apache-2.0
// The scenes of `gnomon bench`: from files, and made for it.
#pragma once

#include <functional>

#include "bench_case.hpp"
#include "render_options.hpp"
#include "synthetic_scene.hpp"

namespace gnomon::cli {

struct BenchScene {
    std::string name;
    Scene scene;
    uint32_t camera = 0;
    /// Of the scene, while the shutter is open speed times as long, or things move speed times as far.
    std::function<std::vector<Pose>(const Scene& scene, double speed, uint32_t segments)> poses;
};

/// A scene file as the options of a render want it. For any speed that comes in turn the camera is the same, where it is made.
BenchScene scene_of_file(const std::string& path, const RenderOptions& options, const std::vector<double>& speeds);

BenchScene scene_of(const Synthetic& synthetic, uint32_t seed);

}  // namespace gnomon::cli
