// SPDX-License-Identifier: Apache-2.0
// The scene runner: a run through a hall, after the runner in the Sponza of Andersson et al. 2015 (Fig. 14).
#include "common.hpp"
#include "figure.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

// The hall lies along X. On either side of its nave stands an arcade, with a gallery of small columns on top.
constexpr int kBays = 7;
constexpr double kBay = 2.4, kHalfNave = 3.0, kHalfWidth = 6.0, kThickness = 0.56;
constexpr double kSpring = 2.8, kArch = 0.92, kGallery = 4.3, kTop = 6.1;
constexpr double kHalfLength = kBay * kBays / 2.0;
constexpr double kJoint = 0.002;  // Between stones, so that no two of them share a vertex.

Mesh moved(Mesh mesh, Vec3 by) {
    mesh.map([&](Vec3 p) { return p + by; });
    return mesh;
}

/// Call place(x, z) for both rows, at `count` + 1 places along each.
template <class Place>
void for_both_rows(int count, const Place& place) {
    for (const double z : {-kHalfNave, kHalfNave}) {
        for (int i = 0; i <= count; ++i) place(kHalfLength * (2.0 * i / count - 1.0), z);
    }
}

Mesh columns(uint32_t triangles) {
    static constexpr ProfilePoint kLarge[] = {
        {0.36, 0.0}, {0.36, 0.14}, {0.31, 0.17}, {0.34, 0.21}, {0.34, 0.25},  {0.29, 0.3},  {0.25, 0.34}, {0.245, 1.4},
        {0.21, 2.3}, {0.24, 2.33}, {0.24, 2.37}, {0.21, 2.4},  {0.215, 2.48}, {0.32, 2.64}, {0.34, 2.65}, {0.34, 2.81}};
    static constexpr ProfilePoint kSmall[] = {{0.13, 0.0}, {0.13, 0.07}, {0.09, 0.12}, {0.08, 0.7},
                                              {0.07, 1.2}, {0.12, 1.32}, {0.13, 1.33}, {0.13, 1.42}};
    constexpr int kSmallIntervals = 3 * kBays;
    const Mesh large = lathe(kLarge, triangles * 7 / 10 / (2 * (kBays + 1)));
    const Mesh small = lathe(kSmall, triangles * 3 / 10 / (2 * (kSmallIntervals + 1)));
    Mesh all;
    for_both_rows(kBays, [&](double x, double z) { all.append(moved(large, {x, 0.0, z})); });
    for_both_rows(kSmallIntervals, [&](double x, double z) { all.append(moved(small, {x, kGallery - 0.01, z})); });
    return all;
}

/// A stone block of one bay with a half round cut out of its lower side.
Mesh arch(uint32_t triangles) {
    Mesh mesh = box({1.0, 1.0, 1.0}, box_divisions(triangles));
    mesh.map([](Vec3 p) {
        constexpr double kShare = 0.8;  // Of the grid, over the opening.
        const double pier = kBay / 2.0 - kJoint - kArch, over = std::abs(p.x);
        const double reach =
            over < kShare ? kArch * std::sin(kPi / 2.0 * over / kShare) : kArch + pier * (over - kShare) / (1.0 - kShare);
        const double low = over < kShare ? kSpring + kArch * std::cos(kPi / 2.0 * over / kShare) : kSpring;
        return Vec3{std::copysign(reach, p.x), low + (kGallery - 0.2 - low) * (p.y + 1.0) / 2.0, kThickness / 2.0 * p.z};
    });
    mesh.smooth_normals();
    return mesh;
}

Mesh walls(uint32_t triangles) {
    const Mesh bay = arch(triangles * 8 / 10 / (2 * kBays));
    Mesh all;
    for (const double z : {-kHalfNave, kHalfNave}) {
        for (int i = 0; i < kBays; ++i) all.append(moved(bay, {kBay * (i + 0.5) - kHalfLength, 0.0, z}));
    }
    // Two cornices on each arcade, and the outer walls.
    const auto add = [&](Vec3 half_size, Vec3 center) {
        all.append(moved(box(half_size, box_divisions(triangles / 50)), center));
    };
    for (const double z : {-1.0, 1.0}) {
        add({kHalfLength + 0.1, 0.11, kThickness / 2.0 + 0.1}, {0.0, kGallery - 0.1, z * kHalfNave});
        add({kHalfLength + 0.1, 0.2, kThickness / 2.0}, {0.0, kTop - 0.2, z * kHalfNave});
        add({kHalfLength + 0.5, kGallery / 2.0, 0.2}, {0.0, kGallery / 2.0, z * (kHalfWidth + 0.2)});
        add({0.2, kGallery / 2.0, kHalfWidth - kJoint}, {z * (kHalfLength + 0.7), kGallery / 2.0, 0.0});
        for (int i = 0; i <= kBays; ++i) {  // Pilasters.
            all.append(
                moved(box({0.2, kGallery / 2.0 - 0.3, 0.08}, 1), {kBay * i - kHalfLength, kGallery / 2.0 - 0.3, z * 5.93}));
        }
    }
    return all;
}

}  // namespace

void make_runner(const std::filesystem::path& path, const RunnerOptions& options) {
    require_range("triangles", options.triangles, 20000, 2e6);
    const auto share = [&](double of_all) { return static_cast<uint32_t>(std::lround(of_all * options.triangles)); };
    GltfWriter writer("runner");
    const auto divisions = static_cast<uint32_t>(std::lround(std::sqrt(share(0.06) / 2.0)));
    Mesh floor = sheet(divisions, divisions, [](double u, double v) {
        return Vec3{(kHalfLength + 0.6) * (2.0 * u - 1.0), 0.0, kHalfWidth * (1.0 - 2.0 * v)};
    });
    for (auto& uv : floor.uvs) uv = {0.5 * kBay * kBays * uv[0], kHalfWidth * uv[1]};
    const auto add_still = [&](const std::string& name, const Mesh& mesh, int material) {
        const Primitive primitive{&mesh, material};
        writer.add_mesh_node(name, writer.add_mesh(name, {&primitive, 1}));
    };
    add_still("floor", floor, add_checker_material(writer, "floor"));
    add_still("columns", columns(share(0.44)), writer.add_material("columns", from_srgb(226, 212, 184)));
    add_still("walls", walls(share(0.3)), writer.add_material("walls", from_srgb(214, 186, 150)));
    const Mesh body = figure_body(share(0.2));
    add_figure(writer, "runner", body, figure_run(body));

    writer.add_camera("camera", {2.5, 1.25, 2.75}, {0.0, 1.25, -0.3}, 0.68, 16.0 / 9.0, 0.1, 100.0);
    writer.add_directional_light("light", {-0.55, -1.0, -0.34}, {4.0, 9.0, 2.0}, {1.0, 0.95, 0.86}, 4.2);
    if (options.fill_light) add_fill_light(writer, {0.4, -1.0, -0.7});
    writer.write(path);
}

}  // namespace gnomon::makers
