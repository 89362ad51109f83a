// SPDX-License-Identifier: Apache-2.0
// Scenes that are made, loaded and posed on the spot.
#include "scenes/posed_scene.hpp"

#include <unistd.h>

#include "scenes/scene_makers.hpp"

namespace gnomon::makers {
namespace {

namespace fs = std::filesystem;

// A file that goes when it is no longer needed.
struct TemporaryFile {
    fs::path path;
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
};

}  // namespace

PosedScene make_posed(const std::function<void(const fs::path&)>& make, uint32_t segments) {
    const TemporaryFile file{fs::temp_directory_path() / ("gnomon_scene." + std::to_string(getpid()) + ".glb")};
    make(file.path);
    PosedScene posed{load_scene(file.path), {}};
    posed.poses = pose_scene(posed.scene, choose_animation(posed.scene, "0"), 0.0, kShutterSeconds, segments);
    return posed;
}

}  // namespace gnomon::makers
