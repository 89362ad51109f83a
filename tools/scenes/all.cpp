// SPDX-License-Identifier: Apache-2.0
// The scenes of the scenes folder.
#include "scene_makers.hpp"

namespace gnomon::makers {

void make_all(const std::filesystem::path& folder) {
    make_figure(folder / "figure.gltf");
    make_two_cubes(folder / "two-cubes.gltf");
    make_random_cubes(folder / "random-cubes.gltf", {.count = 200});
    make_pillars(folder / "pillars.gltf");
    make_crossing_quads(folder / "crossing-quads.gltf");
    make_receding_quads(folder / "receding-quads.gltf");
    make_tube(folder / "tube.gltf", {.triangles = 8000});
}

}  // namespace gnomon::makers
