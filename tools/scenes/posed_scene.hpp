// SPDX-License-Identifier: Apache-2.0
// Scenes that are made, loaded and posed on the spot.
#pragma once

#include <filesystem>
#include <functional>
#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon::makers {

struct PosedScene {
    Scene scene;
    std::vector<Pose> poses;  ///< At segments + 1 times of the shutter, 0 s to kShutterSeconds.
};

/// make: writes the scene to the path that it is given, a temporary file.
/// Errors: those of the maker; ErrorKind::input where the folder for temporary files cannot be written.
PosedScene make_posed(const std::function<void(const std::filesystem::path&)>& make, uint32_t segments = 1);

}  // namespace gnomon::makers
