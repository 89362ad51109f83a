// SPDX-License-Identifier: Apache-2.0
// The scene pillars: a moving spot light.
#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

/// An upright round pillar on y = 0 with a bulge at half height.
Mesh pillar(double radius, double height) {
    constexpr uint32_t kSides = 16, kRings = 7;
    std::vector<Ring> rings;
    for (uint32_t i = 0; i < kRings; ++i) {
        const double share = static_cast<double>(i) / (kRings - 1);
        const double width = radius * (1.0 - 0.3 * share + 0.12 * std::sin(kPi * share));
        rings.push_back({{0.0, height * share, 0.0}, {0.0, 0.0, width}, {width, 0.0, 0.0}});
    }
    return tube({0.0, 0.0, 0.0}, rings, {0.0, height, 0.0}, kSides);
}

/// Half a metre in the first shutter; one turn and a climb of 3 m in a second.
Vec3 circling_light(double half, double seconds) {
    const double angle = 2.0 * kPi * seconds + 0.6;
    return {(1.6 + half * 0.3) * std::cos(angle), 4.8 + 3.0 * seconds, (1.6 + half * 0.3) * std::sin(angle)};
}

/// Up and away from the pillars, by a third of its height in the first shutter.
Vec3 rising_light(double half, double seconds) {
    const double away = 1.0 + 16.0 * seconds;
    return Vec3{-1.2 - 0.5 * half, 3.0 + 0.5 * half, 0.6 + 0.1 * half} * away;
}

}  // namespace

void make_pillars(const std::filesystem::path& path, const PillarsOptions& options) {
    require_range("columns", options.columns, 1, 100);
    constexpr double kSpacing = 1.1;
    const double half = kSpacing * (options.columns - 1) / 2.0;

    GltfWriter writer("pillars");
    add_ground(writer, 2.5 * half + 6.0, 0.0, from_srgb(214, 204, 188));
    Rng rng(7);
    Mesh pillars;
    for (uint32_t row = 0; row < options.columns; ++row) {
        for (uint32_t column = 0; column < options.columns; ++column) {
            Mesh mesh = pillar(rng.in(0.14, 0.22), rng.in(0.7, 1.6));
            mesh.paint(bytes_of((row + column) % 2 == 0 ? from_srgb(228, 150, 96) : from_srgb(110, 158, 168)));
            mesh.map([&](Vec3 p) { return p + Vec3{kSpacing * column - half, 0.0, kSpacing * row - half}; });
            pillars.append(mesh);
        }
    }
    const Primitive primitive{&pillars, writer.add_material("pillars", {})};
    writer.add_mesh_node("pillars", writer.add_mesh("pillars", {&primitive, 1}));

    const std::vector<double> seconds = key_times(1.0, 48);
    std::vector<Vec3> positions;
    std::vector<Quat> rotations;
    for (const double s : seconds) {
        positions.push_back(options.rising ? rising_light(half, s) : circling_light(half, s));
        rotations.push_back(look_rotation(positions.back() * -1.0, {0.0, 1.0, 0.0}));
    }
    const int light = writer.add_spot_light("light", {positions[0], rotations[0]}, {1.0, 0.93, 0.82}, 150.0, 0.7, 1.0);
    const int times = writer.add_times(seconds);
    writer.animate_translation(light, times, positions);
    writer.animate_rotation(light, times, rotations);

    writer.add_camera("camera", {0.0, 3.4 + 1.5 * half, 4.2 + 1.9 * half}, {0.0, 0.2, 0.2 * half}, 0.61, 16.0 / 9.0, 0.1,
                      1000.0);
    writer.write(path);
}

}  // namespace gnomon::makers
