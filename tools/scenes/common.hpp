// SPDX-License-Identifier: Apache-2.0
// What several scenes share.
#pragma once

#include <string>
#include <vector>

#include "gltf_writer.hpp"
#include "mesh.hpp"

namespace gnomon::makers {

/// Throws ErrorKind::usage unless low <= value <= high.
void require_range(const std::string& option, double value, double low, double high);

/// sRGB bytes to the linear values that glTF wants.
Rgb from_srgb(int r, int g, int b);
Rgba bytes_of(Rgb color);

/// count + 1 equally spaced times from 0 to end.
std::vector<double> key_times(double end, uint32_t count);

/// A still horizontal square at height y about (0, 0), two triangles.
void add_ground(GltfWriter& writer, double half_size, double y, Rgb color);

/// For a light at `position` that shines at `target`, not straight up or down.
Placement looking_at(Vec3 position, Vec3 target);

/// A weak bluish directional light, the scene's second: it shows what the first leaves black.
void add_fill_light(GltfWriter& writer, Vec3 direction);

/// A white material with a checker of 2 x 2 fields to a unit of uv.
int add_checker_material(GltfWriter& writer, const std::string& name);

/// A chequered floor of 18 x 9 m, y = 0, with a wall behind it at -Z, turned about Y by `turn` radians
/// and scaled.
void add_studio(GltfWriter& writer, double turn = 0.0, double scale = 1.0);

}  // namespace gnomon::makers
