// SPDX-License-Identifier: Apache-2.0
// Two quads over a plane, after the difficult scenes of Andersson et al. 2015: crossing-quads (Fig. 12) and receding-quads
// (Fig. 13).
#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

// A level square of this half side, that moves evenly from the first key to the last.
void add_quad(GltfWriter& writer, const std::string& name, Rgb color, double half, int times, Vec3 start, Vec3 end) {
    const Mesh mesh = sheet(1, 1, [&](double u, double v) {
        return Vec3{half * (2.0 * u - 1.0), 0.0, half * (1.0 - 2.0 * v)};
    });
    const Primitive primitive{&mesh, writer.add_material(name, color)};
    const int node = writer.add_mesh_node(name, writer.add_mesh(name, {&primitive, 1}), {start, {}});
    const Vec3 keys[] = {start, end};
    writer.animate_translation(node, times, keys);
}

const Rgb kGround = from_srgb(206, 202, 192), kOrange = from_srgb(232, 138, 62), kGreen = from_srgb(108, 164, 92);

}  // namespace

void make_crossing_quads(const std::filesystem::path& path) {
    GltfWriter writer("crossing-quads");
    add_ground(writer, 6.0, 0.0, kGround);
    const int times = writer.add_times(key_times(kShutterSeconds, 1));
    add_quad(writer, "high quad", kOrange, 0.5, times, {-1.5, 1.6, 0.0}, {1.5, 1.6, 0.0});
    add_quad(writer, "low quad", kGreen, 0.5, times, {0.0, 0.8, -1.5}, {0.0, 0.8, 1.5});
    writer.add_camera("camera", {2.2, 4.6, 4.4}, {0.0, 0.6, 0.0}, 0.7, 16.0 / 9.0, 0.1, 100.0);
    writer.add_directional_light("light", {0.2, -1.0, -0.25}, {-1.6, 8.0, 2.0}, {1.0, 0.97, 0.92}, 3.2);
    writer.write(path);
}

void make_receding_quads(const std::filesystem::path& path) {
    GltfWriter writer("receding-quads");
    add_ground(writer, 6.0, 0.0, kGround);
    const int times = writer.add_times(key_times(kShutterSeconds, 1));
    add_quad(writer, "rising quad", kOrange, 0.6, times, {-0.9, 0.4, 0.0}, {-0.9, 2.2, 0.0});
    add_quad(writer, "sinking quad", kGreen, 0.6, times, {0.9, 2.2, 0.0}, {0.9, 0.4, 0.0});
    writer.add_camera("camera", {0.6, 4.4, 5.2}, {0.0, 0.7, 0.0}, 0.7, 16.0 / 9.0, 0.1, 100.0);
    const Vec3 position{0.25, 5.0, 0.2};
    writer.add_spot_light("light", {position, look_rotation(position * -1.0, {0.0, 0.0, -1.0})}, {1.0, 0.95, 0.86}, 110.0, 0.6,
                          0.8);
    writer.write(path);
}

}  // namespace gnomon::makers
