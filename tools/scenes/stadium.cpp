// SPDX-License-Identifier: Apache-2.0
// The scene stadium: a finely tessellated body of a metre on a ground of 200 m.
#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

constexpr double kGround = 200.0;

/// A vase with a waist, so that it shadows itself.
Mesh vase(uint32_t triangles) {
    std::vector<ProfilePoint> profile;
    constexpr int kPoints = 12;
    for (int i = 0; i <= kPoints; ++i) {
        const double share = static_cast<double>(i) / kPoints;
        profile.push_back({0.3 + 0.2 * std::cos(2.0 * kPi * share), 0.02 + 0.96 * share});
    }
    Mesh mesh = lathe(profile, triangles);
    mesh.smooth_normals();
    return mesh;
}

}  // namespace

void make_stadium(const std::filesystem::path& path, const StadiumOptions& options) {
    require_range("triangles", options.triangles, 1000, 4e6);
    require_range("motion", options.motion, 0.0, 10.0);
    GltfWriter writer("stadium");
    add_ground(writer, 0.5 * kGround, 0.0, from_srgb(170, 204, 170));
    const Mesh mesh = vase(options.triangles);
    const Primitive primitive{&mesh, writer.add_material("body", from_srgb(243, 230, 217))};
    const int body = writer.add_mesh_node("body", writer.add_mesh("body", {&primitive, 1}));
    const Vec3 places[] = {{-0.5 * options.motion, 0.0, 0.0}, {1.5 * options.motion, 0.0, 0.0}};
    writer.animate_translation(body, writer.add_times(key_times(2.0 * kShutterSeconds, 1)), places);

    const Vec3 to_light = normalized({-0.5, 0.75, 0.45});
    writer.add_camera("camera", {1.5, 1.5, 3.0}, {0.0, 0.45, 0.0}, 0.7, 4.0 / 3.0, 0.05, 400.0);
    writer.add_directional_light("light", to_light * -1.0, to_light * 5.0, {1.0, 0.97, 0.92}, 3.2);
    writer.write(path);
}

}  // namespace gnomon::makers
