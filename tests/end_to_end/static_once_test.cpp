// SPDX-License-Identifier: Apache-2.0
// What stands still, listed once, gives the picture that it gives listed in each cell of time.
#include <gtest/gtest.h>

#include "shapes.hpp"

namespace gnomon::test {
namespace {

// Many triangles that stand still, few that move.
MovingTriangles spheres(uint32_t segments) {
    MovingTriangles scene(segments);
    add_floor(scene, 0.0f, 6.0f);
    for (const float x : {-1.5f, 0.0f, 1.5f}) add_sphere(scene, {x, 0.7f, 0.0f}, 0.6f, 24);
    add_sphere(scene, {-1.0f, 1.6f, 1.2f}, 0.3f, 10, {1.8f, -0.4f, -0.6f});
    add_quad(scene, {-2.0f, 2.0f, -1.0f}, {0.4f, 0.0f, 0.1f}, {0.0f, 0.3f, 0.4f}, {3.0f, 0.2f, 0.5f});
    return scene;
}

Light lamp() {
    Light light;
    light.kind = LightKind::point;
    light.intensity = 20.0f;
    return light;
}

struct Both {
    Frame once, always;
};

Both render_both(const PosedScene& posed, RenderSettings settings) {
    Both both;
    both.once = shared_renderer().render(posed.scene, posed.poses, settings);
    settings.static_once = false;
    both.always = shared_renderer().render(posed.scene, posed.poses, settings);
    EXPECT_EQ(hash_of(both.once), hash_of(both.always));
    EXPECT_GT(both.once.stats.counts.at("still_triangles"), 4000u);
    return both;
}

// The camera's lists and the lights', which are of all kinds, in one segment and in several.
TEST(StaticOnce, HasTheSamePicture) {
    for (const uint32_t segments : {1u, 2u, 16u}) {
        SCOPED_TRACE(segments);
        MovingTriangles scene = spheres(segments);
        scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
        scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
        scene.add(spot(0.6f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
        scene.add(lamp(), {{{2.5, 3.0, 1.5}, {}}});
        RenderSettings settings = small_settings(80, 60, 8, 256);
        for (const char* pages : {"all", "asked"}) {
            for (const char* layout : {"array", "linked"}) {
                if (segments > 1 && layout != std::string("array")) continue;
                settings.pages = pages;
                settings.layout = layout;
                const Both both = render_both(scene, settings);
                EXPECT_LT(both.once.stats.counts.at("bin_entries.camera") * 2,
                          both.always.stats.counts.at("bin_entries.camera"));
                for (const char* light : {"0", "1", "2"}) {
                    const std::string ranges = std::string("ranges.") + light;
                    EXPECT_LT(both.once.stats.counts.at(ranges) * 5, both.always.stats.counts.at(ranges) * 4)
                        << ranges << pages;
                }
            }
        }
        settings.layout = "array";
        settings.memory_budget = 40u << 20;
        settings.pages = "auto";
        render_both(scene, settings);
    }
}

// Where a view moves nothing stands still in it; where nothing moves but the camera, all does in the light's.
TEST(StaticOnce, NotInAViewThatMoves) {
    MovingTriangles scene = spheres(1);
    scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0}), at({2.4, 3.4, 4.8}, {0.1, 0.6, 0.0})});
    scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}, {glm::dvec3(0.0), looking({-0.4, -1.0, -0.3})}});
    const RenderSettings settings = small_settings(80, 60, 8, 256);
    const Both moving = render_both(scene, settings);
    for (const char* name : {"bin_entries.camera", "ranges.0"})
        EXPECT_EQ(moving.once.stats.counts.at(name), moving.always.stats.counts.at(name)) << name;

    MovingTriangles still(1);
    for (const float x : {-1.5f, 0.0f, 1.5f}) add_sphere(still, {x, 0.7f, 0.0f}, 0.6f, 24);
    still.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0}), at({2.4, 3.4, 4.8}, {0.1, 0.6, 0.0})});
    still.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
    const Both all = render_both(still, settings);
    EXPECT_LT(all.once.stats.counts.at("ranges.0") * 3, all.always.stats.counts.at("ranges.0"));
}

// The methods whose picture depends on the texels list everything in each cell.
TEST(StaticOnce, OfMethodsWithTexels) {
    MovingTriangles scene = spheres(1);
    scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
    scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
    RenderSettings settings = small_settings(80, 60, 8, 256);
    for (const char* method : {"dtr-analytic", "temporal", "tsm"}) {
        settings.method = method;
        render_both(scene, settings);
    }
}

}  // namespace
}  // namespace gnomon::test
