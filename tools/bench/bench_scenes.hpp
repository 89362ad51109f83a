// SPDX-License-Identifier: Apache-2.0
// The rows of the benchmark: scenes, made on the spot, and the frames that are made of them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/posed_scene.hpp"

namespace gnomon::bench {

using makers::PosedScene;

struct BenchScene {
    std::string name;
    std::string group;   ///< One name for several scenes. That of growth curves is what grows.
    double value = 0.0;  ///< On a growth curve: how much of it. 0: this is on none.
    std::vector<uint32_t> spp = {8};
    uint32_t width = 1024, height = 768;
    uint32_t shadow_res = 1024;
    uint32_t lights = 1;  ///< Suns are added up to this number.
    bool point = false;   ///< The scene's light shines to all sides.
    uint32_t count = 0;   ///< What the maker makes, at full size.
    uint32_t least = 1;   ///< What it allows.
    std::function<void(const std::filesystem::path&, uint32_t count)> make;
};

/// All, in the order of the tables.
const std::vector<BenchScene>& bench_scenes();

/// What choose_scenes takes: names of scenes, of groups, and `growth` for all growth curves.
std::vector<std::string> scene_names();

inline constexpr const char* kDefaultScenes = "frames";

/// In the order of the tables, each once. Errors: ErrorKind::usage for a name that is none of scene_names().
std::vector<BenchScene> choose_scenes(const std::vector<std::string>& names);

/// Make, load and pose a scene. scale, > 0: of the image's sides; the number of triangles goes with its square, within what the
/// makers allow, so that triangles keep their size in pixels.
/// Errors: ErrorKind::input where the folder for temporary files cannot be written.
PosedScene make_scene(const BenchScene& scene, double scale);

}  // namespace gnomon::bench
