// SPDX-License-Identifier: Apache-2.0
// The scene tube: one large skinned mesh that moves by a given number of pixels.
#include <algorithm>

#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

constexpr double kHalfLength = 1.62, kRadius = 0.85, kHeight = 1.1;
constexpr double kYfov = 0.6;
constexpr double kDistance = 4.2;
constexpr uint32_t kJoints = 9;

double joint_x(uint32_t joint) { return kHalfLength * (2.0 * joint / (kJoints - 1) - 1.0); }

/// A corrugated tube along X about (0, kHeight, 0), bound to the two joints nearest to each vertex.
Mesh tube_mesh(uint32_t triangles) {
    const Cut cut = cut_for(triangles, kHalfLength / (kPi * kRadius));
    std::vector<Ring> rings;
    for (uint32_t r = 1; r <= cut.rings; ++r) {
        const double share = static_cast<double>(r) / (cut.rings + 1);
        const double x = -kHalfLength * std::cos(kPi * share) * 0.35 + kHalfLength * (2.0 * share - 1.0) * 0.65;
        const double end = kHalfLength - std::abs(x);
        const double rounding = end < kRadius ? std::sqrt(1.0 - (1.0 - end / kRadius) * (1.0 - end / kRadius)) : 1.0;
        const double width = rounding * kRadius * (1.0 + 0.03 * std::sin(30.0 * x));
        rings.push_back({{x, kHeight, 0.0}, {0.0, width, 0.0}, {0.0, 0.0, width}});
    }
    Mesh mesh = tube({-kHalfLength, kHeight, 0.0}, rings, {kHalfLength, kHeight, 0.0}, cut.sides);
    const Rgba bright = bytes_of(from_srgb(240, 226, 198)), dark = bytes_of(from_srgb(58, 128, 140));
    for (const Vec3& p : mesh.positions) {
        const double along = (p.x / kHalfLength + 1.0) / 2.0 * (kJoints - 1);
        const auto first = static_cast<uint16_t>(std::clamp(static_cast<int>(along), 0, static_cast<int>(kJoints) - 2));
        mesh.bind_next(first, static_cast<uint16_t>(first + 1), along - first);
        mesh.colors.push_back(std::sin(10.0 * p.x) > 0.0 ? bright : dark);
    }
    return mesh;
}

}  // namespace

void make_tube(const std::filesystem::path& path, const TubeOptions& options) {
    require_range("triangles", options.triangles, 1000, 2e6);
    require_range("pixels", options.pixels, 0.0, 200.0);
    require_range("ground", options.ground, 1.0, 1e3);
    GltfWriter writer("tube");
    add_ground(writer, 0.5 * options.ground, 0.0, from_srgb(200, 204, 204));

    const Mesh mesh = tube_mesh(options.triangles);
    const Primitive primitive{&mesh, writer.add_material("tube", {})};
    const int times = writer.add_times(key_times(2.0 * kShutterSeconds, 4));
    // Seen at the tube's distance. The whole tube rises by this much in a shutter while its ends rise and its middle sinks by
    // up to a third of it.
    const double metres = options.pixels * 2.0 * kDistance * std::tan(kYfov / 2.0) / 768.0;
    const int root = writer.add_node("skeleton");
    std::vector<int> joints;
    std::vector<Vec3> bind_positions;
    for (uint32_t j = 0; j < kJoints; ++j) {
        const double x = joint_x(j), bow = x / kHalfLength;
        bind_positions.push_back({x, kHeight, 0.0});
        std::vector<Vec3> translations;
        std::vector<Quat> rotations;
        for (int key = 0; key <= 4; ++key) {
            const double shutters = key / 2.0;
            const double bend = 0.12 + metres * shutters / 3.0;  // y = bend (2 bow^2 - 1)
            translations.push_back({x, kHeight + metres * shutters + bend * (2.0 * bow * bow - 1.0), 0.0});
            rotations.push_back(axis_angle({0.0, 0.0, 1.0}, std::atan(bend * 4.0 * bow / kHalfLength)));
        }
        const int joint = writer.add_node("joint " + std::to_string(j), {translations[0], rotations[0]}, root);
        writer.animate_translation(joint, times, translations);
        writer.animate_rotation(joint, times, rotations);
        joints.push_back(joint);
    }
    writer.add_skinned_node("tube", writer.add_mesh("tube", {&primitive, 1}), joints, bind_positions);

    const Vec3 to_light = normalized({-0.4, 1.0, 0.55});
    writer.add_camera("camera", {0.0, kHeight + 0.9, kDistance - 0.1}, {0.0, kHeight - 0.05, 0.0}, kYfov, 4.0 / 3.0, 0.1, 50.0);
    writer.add_directional_light("light", to_light * -1.0, to_light * 5.0, {1.0, 0.97, 0.92}, 3.3);
    writer.write(path);
}

}  // namespace gnomon::makers
