// SPDX-License-Identifier: Apache-2.0
#include "check_scene.hpp"

#include "made_scene.hpp"

namespace gnomon::cli {

namespace {

constexpr double kSpacing = 0.5, kHeight = 1.0;  ///< Metres between stacks; of a stack.
constexpr uint32_t kColumns = 8;

std::vector<uint32_t> lengths(bool longest) {
    std::vector<uint32_t> all;
    for (uint32_t n = 1; n <= 33; ++n) all.push_back(n);
    for (uint32_t n = 64; n <= 1024; n *= 2) all.insert(all.end(), {n - 1, n, n + 1});
    if (longest) all.push_back(20'000);
    return all;
}

}  // namespace

CheckScene::CheckScene(const std::vector<LightKind>& lights, uint32_t segments, bool longest) {
    scene.path = "the scene of layouts check";
    scene.materials.emplace_back();
    scene.morphs.emplace_back();
    const std::vector<uint32_t> all = lengths(longest);
    const double half = 0.5 * kSpacing * kColumns + kSpacing;
    add_triangle(
        scene, {{-2.0 * half, -kHeight, -2.0 * half}, {-2.0 * half, -kHeight, 3.0 * half}, {3.0 * half, -kHeight, -2.0 * half}},
        0);
    for (size_t i = 0; i < all.size(); ++i) {
        const double x = (static_cast<double>(i % kColumns) + 0.5) * kSpacing - half,
                     z = (static_cast<double>(i / kColumns) + 0.5) * kSpacing - half;
        for (uint32_t n = 0; n < all[i]; ++n) {
            // Tilted by turns, so that depths cross.
            const double y = kHeight * (n + 1.0) / (all[i] + 1.0), tilt = (n % 2 == 0 ? 0.4 : -0.4) * kHeight / (all[i] + 1.0);
            const double size = 0.1 + 0.1 * ((n * 7) % 5);
            add_triangle(scene, {{x, y - tilt, z}, {x, y + tilt, z + size * kSpacing}, {x + size * kSpacing, y, z}}, i % 2);
        }
    }
    const double eye = 6.0;
    scene.cameras.push_back({"above", -1, CameraKind::perspective, 0.9, 0.0, 1.0, 1.0, 0.01, 0.0});
    for (const LightKind kind : lights) {
        Light& light = scene.lights.emplace_back();
        light.kind = kind;
        light.intensity = 1.0f;
        light.outer_cone = 0.7f;
    }
    for (uint32_t k = 0; k <= segments; ++k) {
        Pose& pose = poses.emplace_back();
        const double t = static_cast<double>(k) / segments;
        pose.palette = {{1, 0, 0, 0},       {0, 1, 0, 0},       {0, 0, 1, 0},
                        {1, 0, 0, 0.7 * t}, {0, 1, 0, 0.1 * t}, {0, 0, 1, 0.3 * t * t}};
        pose.cameras.push_back(looking_down({0.1, eye, 0.2}, 0.03));
        for (const LightKind kind : lights)
            pose.lights.push_back(
                looking_down({0.3, kind == LightKind::point ? 2.5 : 5.0, 0.4}, kind == LightKind::directional ? 0.2 : 0.05));
    }
    settings.width = 45;
    settings.height = 37;
    settings.spp = 4;
    settings.shadow_res = longest ? 92 : 400;
    settings.keep_ranges = true;
}

}  // namespace gnomon::cli
