// SPDX-License-Identifier: Apache-2.0
// Pages that are made where hits ask for them give the picture of all pages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

#include "methods/method.hpp"
#include "scenes/scene_makers.hpp"
#include "shapes.hpp"
#include "support/paths.hpp"

namespace gnomon::test {
namespace {

/// The hash of the picture is the same; of the ranges that `all` makes, `asked` makes at most so many.
void expect_same(const PosedScene& posed, RenderSettings settings, double most_ranges) {
    settings.pages = "all";
    const Frame all = shared_renderer().render(posed.scene, posed.poses, settings);
    settings.pages = "asked";
    const Frame asked = shared_renderer().render(posed.scene, posed.poses, settings);
    EXPECT_EQ(hash_of(asked), hash_of(all));
    uint64_t made = 0, there = 0;
    for (size_t i = 0; i < posed.scene.lights.size(); ++i) {
        const std::string name = "ranges." + std::to_string(i);
        if (asked.stats.counts.count(name) != 0) made += asked.stats.counts.at(name);
        there += all.stats.counts.at(name);
    }
    EXPECT_LE(static_cast<double>(made), most_ranges * static_cast<double>(there)) << made << " of " << there;
    EXPECT_GT(there, 0u);
}

TEST(Pages, GiveEveryMethodsPicture) {
    MovingTriangles scene = still_life(2);
    scene.add(spot(0.6f, 0.3f, 20.0f), {at({2.0, 5.0, 1.0}, {0.0, 0.5, 0.0})});
    for (const Method& method : methods()) {
        if (!method.has_s_buffer()) continue;
        for (const std::string& raster : method.rasters) {
            for (const char* layout : {"array", "linked"}) {
                SCOPED_TRACE(method.name + " " + raster + " " + layout);
                RenderSettings settings = small_settings(72, 50, 6, 200);
                settings.method = method.name;
                settings.raster = raster;
                settings.layout = layout;
                expect_same(scene, settings, 1.0);
                settings.memory_budget = 5u << 20;
                expect_same(scene, settings, 1.0);
            }
        }
    }
}

TEST(Pages, GiveTheScenesPictures) {
    for (const char* name : {"figure", "two-cubes", "random-cubes", "pillars", "tube", "receding-quads", "crossing-quads"}) {
        for (const uint32_t segments : {1u, 3u}) {
            SCOPED_TRACE(name + std::string(", segments ") + std::to_string(segments));
            const PosedScene posed = load_posed(
                std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes" / (std::string(name) + ".gltf"), {"0", segments});
            expect_same(posed, small_settings(160, 120, 7, 512), 2.0);  // Parts of pages have finer texels.
        }
    }
}

// A dense body in a wide scene: its pages are split, in space, and where it moves in time.
TEST(Pages, OfADenseBodyAreSplit) {
    for (const double metres : {0.0, 0.3, 4.0}) {
        SCOPED_TRACE(metres);
        const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "pages_stadium.glb";
        makers::make_stadium(path, {.triangles = 6000, .motion = metres});
        const PosedScene posed = load_posed(path);
        RenderSettings settings = small_settings(96, 72, 8, 256);
        settings.count_ranges = true;
        settings.closed_meshes = false;  // The view is the scene's, in which the body is dense.
        for (const char* layout : {"array", "linked"}) {
            settings.layout = layout;
            expect_same(posed, settings, 30.0);
        }
        settings.layout = "array";
        settings.pages = "all";
        const Frame all = shared_renderer().render(posed.scene, posed.poses, settings);
        settings.pages = "asked";
        for (const uint64_t budget : {0ull, 24ull << 20, 14ull << 20}) {
            settings.memory_budget = budget;
            const Frame asked = shared_renderer().render(posed.scene, posed.poses, settings);
            EXPECT_EQ(hash_of(asked), hash_of(all)) << "budget " << budget;
            EXPECT_LT(asked.stats.counts.at("ranges_visited") * 4, all.stats.counts.at("ranges_visited"));
        }
    }
}

// A floor that nothing stands on asks for little: where its two triangles meet. One beside a box, for what lies under it.
TEST(Pages, AreFewWhereLittleIsShadowed) {
    MovingTriangles scene(1);
    scene.add(Camera(), {at({0.0, 8.0, 8.0}, {0.0, 0.0, 0.0})});
    scene.add(sun(1.0f), {{glm::dvec3(0.0), looking({0.3, -1.0, -0.2})}});
    add_floor(scene, 0.0f, 20.0f);
    RenderSettings settings = small_settings(90, 70, 4, 512);
    settings.closed_meshes = false;  // Else the floor is listed nowhere.
    expect_same(scene, settings, 0.02);
    add_box(scene, {0.0f, 1.0f, 0.0f}, {0.5f, 0.5f, 0.5f}, {0.4f, 0.0f, 0.0f});
    expect_same(scene, settings, 0.05);
}

}  // namespace
}  // namespace gnomon::test
