// SPDX-License-Identifier: Apache-2.0
// The scene figure: a walk through a studio.
#include "figure.hpp"

#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

/// Closed blades around the Z axis, each a thin box twisted out of the plane and narrow at the hub.
Mesh pinwheel_blades(uint32_t triangles) {
    constexpr uint32_t kBlades = 6;
    static const Rgb kColors[] = {from_srgb(226, 88, 74), from_srgb(244, 226, 188), from_srgb(62, 140, 150)};
    const uint32_t divisions = box_divisions(triangles / kBlades);
    Mesh blades;
    for (uint32_t i = 0; i < kBlades; ++i) {
        Mesh blade = box({1.0, 1.0, 1.0}, divisions);
        blade.map([&](Vec3 p) {
            const double r = (p.x + 1.0) / 2.0;
            const double chord = 0.02 + 0.15 * std::sin(kPi * std::min(1.0, 0.12 + 0.75 * r));
            const double pitch = 0.25 + 0.35 * (1.0 - r);
            const Vec3 local{0.03 + 0.46 * r, chord * (p.y + 1.0) / 2.0, 0.006 * p.z};
            return rotate(axis_angle({0, 0, 1}, 2.0 * kPi * i / kBlades), rotate(axis_angle({1, 0, 0}, pitch), local));
        });
        blade.smooth_normals();
        blade.paint(bytes_of(kColors[i % std::size(kColors)]));
        blades.append(blade);
    }
    return blades;
}

void add_pinwheel(GltfWriter& writer, uint32_t triangles, Vec3 foot, double heading) {
    constexpr double kHub = 1.25, kTurnsPerSecond = 2.0;
    const Quat facing = axis_angle({0, 1, 0}, heading);
    Mesh stick;
    const Ring stick_rings[] = {{{0, 0, 0}, {0, 0, 0.016}, {0.016, 0, 0}}, {{0, kHub + 0.04, 0}, {0, 0, 0.016}, {0.016, 0, 0}}};
    stick = tube({0, 0, 0}, stick_rings, {0, kHub + 0.04, 0}, 8);
    const Primitive wood{&stick, writer.add_material("stick", from_srgb(120, 84, 62))};
    const int stand = writer.add_mesh_node("stick", writer.add_mesh("stick", {&wood, 1}), {foot, facing});

    Mesh wheel = pinwheel_blades(triangles);
    Mesh hub = sphere(0.035, {12, 8});
    hub.paint(bytes_of(from_srgb(60, 52, 50)));
    wheel.append(hub);
    const Primitive blades{&wheel, writer.add_material("pinwheel", {})};
    const int node = writer.add_mesh_node("pinwheel", writer.add_mesh("pinwheel", {&blades, 1}), {{0, kHub, 0.06}, {}}, stand);
    const std::vector<double> seconds = key_times(1.0, 24);
    std::vector<Quat> rotations;
    for (const double s : seconds) rotations.push_back(axis_angle({0, 0, 1}, -2.0 * kPi * kTurnsPerSecond * s));
    writer.animate_rotation(node, writer.add_times(seconds), rotations);
}

/// A striped ball that bounces twice a second, on its way down at 0 s.
void add_ball(GltfWriter& writer, uint32_t triangles, Vec3 below) {
    constexpr double kRadius = 0.17, kPeriod = 0.5, kGravity = 9.81;
    constexpr uint32_t kStripes = 6;
    const Cut cut = cut_for(triangles, 0.5, kStripes);
    Mesh ball = sphere(kRadius, cut);
    const Rgba colors[] = {bytes_of(from_srgb(240, 178, 62)), bytes_of(from_srgb(246, 240, 226))};
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        const std::size_t side = v == 0 ? 0 : (v - 1) % cut.sides;
        ball.colors.push_back(colors[side * kStripes / cut.sides % 2]);
    }
    const Primitive primitive{&ball, writer.add_material("ball", {})};
    const std::vector<double> seconds = key_times(1.0, 96);
    std::vector<Vec3> translations;
    std::vector<Quat> rotations;
    for (const double s : seconds) {
        const double phase = s + 0.32, t = phase - kPeriod * std::floor(phase / kPeriod);
        translations.push_back(below + Vec3{0.0, kRadius + kGravity / 2.0 * t * (kPeriod - t), 0.0});
        rotations.push_back(axis_angle({0, 0, 1}, 0.5 - 2.0 * kPi * s) * axis_angle({1, 0, 0}, 0.9));
    }
    const int node = writer.add_mesh_node("ball", writer.add_mesh("ball", {&primitive, 1}), {translations[0], rotations[0]});
    const int times = writer.add_times(seconds);
    writer.animate_translation(node, times, translations);
    writer.animate_rotation(node, times, rotations);
}

}  // namespace

void make_figure(const std::filesystem::path& path, const FigureOptions& options) {
    require_range("triangles", options.triangles, 2000, 1e6);
    const auto share = [&](double of_all) { return static_cast<uint32_t>(std::lround(of_all * options.triangles)); };
    GltfWriter writer("figure");

    add_studio(writer);
    const Mesh body = figure_body(share(0.83));
    add_figure(writer, "figure", body, figure_walk(body));
    add_pinwheel(writer, share(0.08), {1.2, 0.0, -1.0}, -0.3);
    add_ball(writer, share(0.07), {-0.98, 0.0, 0.55});

    writer.add_camera("camera", {1.25, 1.9, 4.1}, {0.4, 0.84, -0.1}, 35.0 * kPi / 180.0, 16.0 / 9.0, 0.1, 100.0);
    const Vec3 key{0.66, -0.74, -0.62}, fill{-0.75, -0.6, -0.6};
    writer.add_directional_light("key", key, {-3.0, 4.0, 2.5}, {1.0, 0.94, 0.84}, 3.6);
    if (options.fill_light) writer.add_directional_light("fill", fill, {3.0, 4.0, 5.0}, {0.72, 0.84, 1.0}, 0.8);
    writer.write(path);
}

}  // namespace gnomon::makers
