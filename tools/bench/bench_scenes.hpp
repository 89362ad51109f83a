// SPDX-License-Identifier: Apache-2.0
// The scenes of the benchmark, made on the spot.
#pragma once

#include <string>
#include <vector>

#include "scenes/posed_scene.hpp"

namespace gnomon::bench {

using makers::PosedScene;

/// In the order of the tables.
std::vector<std::string> scene_names();

/// Make, load and pose a scene. scale, > 0: of the image's sides; the number of triangles goes with its square, within what the
/// makers allow, so that triangles keep their size in pixels.
/// Errors: ErrorKind::usage for a name that is none of scene_names(); ErrorKind::input where the folder for temporary files
/// cannot be written.
PosedScene make_scene(const std::string& name, double scale);

}  // namespace gnomon::bench
