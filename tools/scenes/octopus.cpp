// SPDX-License-Identifier: Apache-2.0
// The scene octopus, after that of Andersson et al. 2015 (Fig. 1 and 9).
#include <algorithm>

#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

constexpr uint32_t kArms = 8, kJoints = 12, kCups = 22;
constexpr double kLength = 1.9, kRadius = 0.13;

double joint_x(uint32_t joint) { return kLength * joint / kJoints; }
double radius_at(double x) { return kRadius * (1.0 - 0.88 * std::clamp(x / kLength, 0.0, 1.0)); }

/// An arm along +X with two rows of suction cups below it, bound to the two joints nearest to each vertex.
Mesh arm(uint32_t triangles) {
    const Cut cut = cut_for(triangles * 6 / 10, kLength / (kPi * kRadius));
    std::vector<Ring> rings;
    for (uint32_t r = 0; r < cut.rings; ++r) {
        const double x = kLength * r / cut.rings, width = radius_at(x);
        rings.push_back({{x, 0.0, 0.0}, {0.0, width, 0.0}, {0.0, 0.0, width}});
    }
    Mesh mesh = tube({0, 0, 0}, rings, {kLength, 0, 0}, cut.sides);
    mesh.paint(bytes_of(from_srgb(206, 84, 70)));

    const Cut cup_cut = cut_for(triangles * 4 / 10 / (2 * kCups), 0.5);
    for (uint32_t i = 0; i < 2 * kCups; ++i) {
        const uint32_t row = i % 2, place = i / 2;
        const double x = kLength * (0.08 + 0.86 * (place + 0.5 * row) / kCups), width = radius_at(x), size = 0.42 * width;
        const Quat tilt = axis_angle({1, 0, 0}, row == 0 ? 0.5 : -0.5);
        Mesh cup = sphere(size, cup_cut);
        cup.map([&](Vec3 p) { return Vec3{x, 0.0, 0.0} + rotate(tilt, Vec3{p.x, 0.6 * p.y - width - 0.1 * size, p.z}); });
        cup.smooth_normals();
        cup.paint(bytes_of(from_srgb(244, 206, 178)));
        mesh.append(cup);
    }
    for (const Vec3& p : mesh.positions) {
        const double along = std::clamp(p.x / kLength * kJoints - 0.5, 0.0, kJoints - 1.0);
        const auto first = static_cast<uint16_t>(std::min(static_cast<uint32_t>(along), kJoints - 2));
        mesh.bind_next(first, static_cast<uint16_t>(first + 1), along - first);
    }
    return mesh;
}

/// The head and mantle, with two eyes.
Mesh head(uint32_t triangles) {
    constexpr int kPoints = 32;
    std::vector<ProfilePoint> profile;
    for (int i = 1; i < kPoints; ++i) {
        const double angle = kPi * i / kPoints, share = 0.5 - 0.5 * std::cos(angle), waist = (share - 0.3) / 0.12;
        profile.push_back({std::sin(angle) * (0.34 + 0.1 * share - 0.1 * std::exp(-waist * waist)), 1.4 * share - 0.22});
    }
    Mesh mesh = lathe(profile, triangles * 8 / 10);
    mesh.paint(bytes_of(from_srgb(206, 84, 70)));
    for (const double side : {-1.0, 1.0}) {
        Mesh eye = sphere(0.09, cut_for(triangles / 10, 0.5));
        eye.map([&](Vec3 p) { return p + Vec3{0.19 * side, 0.1, 0.21}; });
        eye.paint(bytes_of(from_srgb(250, 240, 206)));
        mesh.append(eye);
    }
    return mesh;
}

/// One arm's joints. Each bends up and down and to the sides, later than the one before it, twice in a second.
std::vector<int> add_arm(GltfWriter& writer, const std::string& name, int body, double heading, int times, Rng& rng) {
    const Quat outward = axis_angle({0, 1, 0}, heading) * axis_angle({0, 0, 1}, rng.in(-0.8, -0.2));
    const Vec3 root = rotate(axis_angle({0, 1, 0}, heading), {0.16, -0.12, 0.0});
    const double phase = rng.in(0.0, 2.0 * kPi), turning = rng.in(0.0, 2.0 * kPi), curl = rng.in(0.02, 0.14);
    std::vector<int> joints;
    for (uint32_t j = 0; j < kJoints; ++j) {
        std::vector<Quat> rotations;
        for (const double s : key_times(1.0, 48)) {
            const double wave = 2.0 * kPi * 2.0 * s + phase - 0.35 * j;
            const Quat bend = axis_angle({0, 0, 1}, curl + 0.19 * std::sin(wave) * std::cos(turning)) *
                              axis_angle({0, 1, 0}, 0.19 * std::sin(wave) * std::sin(turning));
            rotations.push_back(j == 0 ? outward * bend : bend);
        }
        const Vec3 offset = j == 0 ? root : Vec3{joint_x(1), 0.0, 0.0};
        joints.push_back(
            writer.add_node(name + " " + std::to_string(j), {offset, rotations[0]}, j == 0 ? body : joints.back()));
        writer.animate_rotation(joints.back(), times, rotations);
    }
    return joints;
}

}  // namespace

void make_octopus(const std::filesystem::path& path, const OctopusOptions& options) {
    require_range("triangles", options.triangles, 50000, 4e6);
    GltfWriter writer("octopus");
    add_ground(writer, 20.0, 0.0, from_srgb(214, 206, 190));
    const int body = writer.add_node("octopus", {{0.0, 1.75, 0.0}, axis_angle({0, 0, 1}, 0.25)});
    const Mesh mantle = head(options.triangles / 10), limb = arm(options.triangles * 9 / 10 / kArms);
    const Primitive skin{&mantle, writer.add_material("head", {})};
    writer.add_mesh_node("head", writer.add_mesh("head", {&skin, 1}), {}, body);
    const Primitive cups{&limb, writer.add_material("arms", {})};
    const int mesh = writer.add_mesh("arm", {&cups, 1});

    Rng rng(options.seed);
    const int times = writer.add_times(key_times(1.0, 48));
    std::vector<Vec3> bind_positions;
    for (uint32_t j = 0; j < kJoints; ++j) bind_positions.push_back({joint_x(j), 0.0, 0.0});
    for (uint32_t i = 0; i < kArms; ++i) {
        const std::string name = "arm " + std::to_string(i);
        writer.add_skinned_node(name, mesh, add_arm(writer, name, body, 2.0 * kPi * (i + 0.5) / kArms, times, rng),
                                bind_positions);
    }

    writer.add_spot_light("light", looking_at({-3.0, 8.6, 2.4}, {0.5, 0.6, -0.3}), {1.0, 0.96, 0.9}, 400.0, 0.3, 0.62);
    if (options.fill_light) add_fill_light(writer, {0.3, -0.7, -0.8});
    writer.add_camera("camera", {1.6, 4.6, 6.2}, {0.15, 1.05, -0.1}, 0.58, 16.0 / 9.0, 0.1, 100.0);
    // The arms' shadows on the ground, from closely above.
    writer.add_camera("above", {0.1, 2.4, 2.8}, {-0.48, 0.0, 0.62}, 0.5, 1.0, 0.1, 100.0);
    writer.write(path);
}

}  // namespace gnomon::makers
