// SPDX-License-Identifier: Apache-2.0
// Shadows with one side of closed meshes listed are those with both sides.
#include <gtest/gtest.h>

#include <iostream>

#include "methods/method.hpp"
#include "scenes/scene_makers.hpp"
#include "shapes.hpp"

namespace gnomon::test {
namespace {

using Verdict = oracle::SampleJudge::Verdict;

struct Both {
    Frame all, one;
};

Both render_both(const PosedScene& posed, RenderSettings settings) {
    settings.count_ranges = true;
    settings.pages = "all";  // The lists that are compared are then as long as they are.
    Both both;
    settings.closed_meshes = false;
    both.all = sampled_frame(posed, settings);
    settings.closed_meshes = true;
    both.one = sampled_frame(posed, settings);
    return both;
}

// Shadow tests that one side answers otherwise.
struct Changes {
    uint64_t tests = 0, to_dark = 0, to_lit = 0;
    uint64_t wrong = 0;  // Of them, by more than rounding.
    uint64_t count() const { return to_dark + to_lit; }
};

Changes changes_of(const Both& both, const PosedScene& posed, const RenderSettings& settings) {
    const oracle::SampleJudge judge(posed.scene, posed.poses, 0, settings.width, settings.height);
    Changes changes;
    for (size_t i = 0; i < both.all.samples.size(); ++i) {
        const SampleRecord &before = both.all.samples[i], &now = both.one.samples[i];
        EXPECT_EQ(before.triangle, now.triangle);
        if (before.triangle == SampleRecord::kMiss || now.triangle == SampleRecord::kMiss) continue;
        changes.tests += both.all.light_count;
        for (uint32_t light = 0; light < both.all.light_count; ++light) {
            if (((before.lit ^ now.lit) >> light & 1u) == 0) continue;
            const bool lit = (now.lit >> light & 1u) != 0;
            ++(lit ? changes.to_lit : changes.to_dark);
            const oracle::SamplePoint p = sample_at(i, settings.width, settings.spp, settings.seed);
            changes.wrong += judge.shadow(now.triangle, light, lit, p) == Verdict::wrong;
        }
    }
    std::cout << changes.tests << " shadow tests, to dark " << changes.to_dark << ", to lit " << changes.to_lit
              << ", of them wrong " << changes.wrong << "; closed triangles " << both.one.stats.counts.at("closed_triangles")
              << " of " << both.one.stats.counts.at("triangles") << ", ranges visited "
              << both.all.stats.counts.at("ranges_visited") << " and " << both.one.stats.counts.at("ranges_visited")
              << ", tested " << both.all.stats.counts.at("ranges_tested") << " and "
              << both.one.stats.counts.at("ranges_tested") << std::endl;
    return changes;
}

// What changes is rounding, and right.
void expect_same_shadows(const PosedScene& posed, uint64_t closed_triangles,
                         const RenderSettings& settings = small_settings(120, 90, 8)) {
    const Both both = render_both(posed, settings);
    EXPECT_EQ(both.all.stats.counts.at("closed_triangles"), 0u);
    EXPECT_EQ(both.one.stats.counts.at("closed_triangles"), closed_triangles);
    const Changes changes = changes_of(both, posed, settings);
    EXPECT_EQ(changes.wrong, 0u);
    EXPECT_LE(changes.count(), changes.tests / 4000);
    EXPECT_GT(changes.tests, 1000u);
    if (closed_triangles == 0) {
        EXPECT_EQ(hash_of(both.all), hash_of(both.one));
    } else {
        EXPECT_LT(both.one.stats.counts.at("ranges_tested"), both.all.stats.counts.at("ranges_tested"));
    }
}

struct SceneCase {
    std::string name;
    std::function<void(const std::filesystem::path&)> make;
    uint32_t segments = 1;
    uint64_t open_triangles = 2;
};

void PrintTo(const SceneCase& c, std::ostream* out) { *out << c.name; }

class OneSideOfScenes : public testing::TestWithParam<SceneCase> {};

TEST_P(OneSideOfScenes, HasTheShadowsOfBoth) {
    const SceneCase& c = GetParam();
    const PosedScene posed = load_posed(made_file(c.name, c.make), {"0", c.segments});
    RenderSettings settings = small_settings(320, 240, 8);
    for (const uint32_t shadow_res : {64u, 360u}) {  // Which a fitted view has, too.
        settings.shadow_res = shadow_res;
        expect_same_shadows(posed, posed.scene.triangles.size() - c.open_triangles, settings);
    }
}

INSTANTIATE_TEST_SUITE_P(All, OneSideOfScenes,
                         testing::ValuesIn(std::vector<SceneCase>{
                             {"two_cubes", [](const auto& p) { makers::make_two_cubes(p, {6000}); }},
                             {"random_cubes", [](const auto& p) { makers::make_random_cubes(p); }},
                             {"figure", [](const auto& p) { makers::make_figure(p); }, 1, 36},
                             {"pillars", [](const auto& p) { makers::make_pillars(p); }, 12},
                             {"tube", [](const auto& p) { makers::make_tube(p); }},
                             {"crossing_quads", [](const auto& p) { makers::make_crossing_quads(p); }, 1, 6},
                         }),
                         [](const auto& tested) { return tested.param.name; });

constexpr uint64_t kBox = 12, kSphere = 224;

void turn_inside_out(PosedScene& posed) {
    for (Triangle& triangle : posed.scene.triangles) std::swap(triangle.vertex[1], triangle.vertex[2]);
}

// The still life mirrored, and its camera and light with it.
MovingTriangles mirrored_still_life() {
    MovingTriangles scene = still_life(1);
    for (Pose& pose : scene.poses) {
        for (size_t row = 0; row < pose.palette.size(); row += 3) pose.palette[row] *= -1.0f;
        pose.cameras[0] = at({-2.0, 3.5, 5.0}, {0.0, 0.6, 0.0});
        pose.lights[0].rotation = looking({0.5, -1.0, -0.3});
    }
    return scene;
}

// None turns: between keys what moves and what does not would part in the light's view, where they touch.
void add_more_lights(MovingTriangles& scene) {
    scene.add(spot(0.6f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0}), at({-2.0, 4.5, 2.5}, {1.0, 1.0, 0.5})});
    scene.add(sun(), {at({5.0, 0.6, 1.0}, {0.0, 0.5, 0.0})});
    scene.add(spot(0.9f), {at({1.1, 2.0, -4.0}, {0.0, 0.5, 0.0})});
}

TEST(OneSide, OfWhatIsWoundEitherWayOrMirrored) {
    MovingTriangles scene = still_life(1);
    add_more_lights(scene);
    expect_same_shadows(scene, 2 * kBox + kSphere);
    turn_inside_out(scene);
    expect_same_shadows(scene, 2 * kBox + kSphere);
    MovingTriangles mirrored = mirrored_still_life();
    add_more_lights(mirrored);
    expect_same_shadows(mirrored, 2 * kBox + kSphere);
}

TEST(OneSide, OfWhatIntersectsItselfAndOthers) {
    for (const bool inside_out : {false, true}) {
        MovingTriangles scene(2);
        add_floor(scene, 0.0f, 6.0f);
        add_box(scene, {-0.6f, 0.3f, 0.0f}, {0.5f, 0.7f, 0.4f}, {0.5f, 0.1f, 0.2f});
        if (inside_out) turn_inside_out(scene);
        add_sphere(scene, {0.1f, 0.5f, 0.2f}, 0.6f, 8, {-0.3f, 0.2f, 0.1f});
        // A bow tie: a box whose one end is turned over, which crosses itself in the middle.
        const size_t first = scene.scene.vertices.size();
        add_box(scene, {0.9f, 0.6f, 0.9f}, {0.5f, 0.3f, 0.2f}, {0.2f, 0.2f, -0.4f});
        for (size_t v = first; v < scene.scene.vertices.size(); ++v) {
            glm::vec3& p = scene.scene.vertices[v].position;
            if (p.x > 1.0f) p = {p.x, 1.2f - p.y, p.z};
        }
        scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
        scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
        add_more_lights(scene);
        expect_same_shadows(scene, 2 * kBox + kSphere);
    }
}

// What only touches: boxes on the floor, on each other, with an edge in common; then seen from below.
TEST(OneSide, OfWhatTouches) {
    MovingTriangles scene(1);
    add_floor(scene, 0.0f, 6.0f);
    add_box(scene, {-0.5f, 0.5f, 0.0f}, {0.5f, 0.5f, 0.5f});
    add_box(scene, {-0.5f, 1.25f, 0.0f}, {0.25f, 0.25f, 0.25f});
    add_box(scene, {0.5f, 0.5f, 1.0f}, {0.5f, 0.5f, 0.5f});
    add_box(scene, {1.5f, 0.5f, 0.0f}, {0.5f, 0.5f, 0.5f}, {0.0f, 0.0f, 1.0f});
    scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
    scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
    add_more_lights(scene);
    expect_same_shadows(scene, 4 * kBox);
    for (Pose& pose : scene.poses) pose.cameras[0] = at({2.0, -3.5, 5.0}, {0.0, 0.0, 0.0});
    expect_same_shadows(scene, 4 * kBox);
}

// Both sides of a leaf are one place: the light does not reach the one through the other, but not because it is closed.
TEST(OneSide, NotOfSheets) {
    MovingTriangles scene = still_life(1);
    add_quad(scene, {-1.0f, 1.0f, 1.5f}, {0.8f, 0.5f, 0.0f}, {0.0f, 0.5f, -0.8f}, {0.1f, 0.2f, 0.0f});
    add_quad(scene, {-1.0f, 1.0f, 1.5f}, {0.0f, 0.5f, -0.8f}, {0.8f, 0.5f, 0.0f}, {0.1f, 0.2f, 0.0f});
    // The same two triangles, back to back.
    scene.scene.triangles.pop_back();
    scene.scene.triangles.pop_back();
    const std::array<uint32_t, 3> pairs[] = {{0, 2, 1}, {0, 2, 1}};
    const size_t first = scene.scene.triangles.size() - 2;
    for (size_t i = 0; i < 2; ++i) {
        Triangle back = scene.scene.triangles[first + i];
        const Triangle front = back;
        for (size_t k = 0; k < 3; ++k) back.vertex[k] = front.vertex[pairs[i][k]];
        scene.scene.triangles.push_back(back);
    }
    add_more_lights(scene);
    expect_same_shadows(scene, 2 * kBox + kSphere);
}

// The still life seen from a place.
MovingTriangles seen(const Camera& camera, const std::vector<Rigid>& keys) {
    MovingTriangles scene = still_life(1);
    scene.scene.cameras.clear();
    for (Pose& pose : scene.poses) pose.cameras.clear();
    scene.add(camera, keys);
    return scene;
}

TEST(OneSide, NotWhereTheCameraIsInside) {
    // The sphere's centre at the middle of the shutter.
    expect_same_shadows(seen(perspective(1.4), {at({0.55, 0.8, 0.75}, {-1.0, 0.5, 0.0})}), 2 * kBox);
    // It flies into the sphere.
    expect_same_shadows(seen(perspective(1.4), {at({2.0, 1.2, 2.0}, {0.0, 0.5, 0.0}), at({0.8, 0.8, 0.7}, {-1.2, 0.1, -1.3})}),
                        2 * kBox);
    // In a room, with all else in it.
    MovingTriangles scene = still_life(1);
    add_box(scene, {0.0f, 2.0f, 0.0f}, {9.0f, 5.0f, 9.0f});
    scene.add(spot(0.6f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    expect_same_shadows(scene, 2 * kBox + kSphere);
}

TEST(OneSide, NotWhereTheNearPlaneCuts) {
    const Rigid place = at({0.3, 1.2, 5.0}, {0.3, 0.8, 0.0});
    Camera camera = perspective(0.7);
    expect_same_shadows(seen(camera, {place}), 2 * kBox + kSphere);
    camera.znear = 4.0;
    expect_same_shadows(seen(camera, {place}), 2 * kBox);
    camera = orthographic(1.8);
    expect_same_shadows(seen(camera, {place}), 2 * kBox + kSphere);
    camera.znear = 4.0;
    expect_same_shadows(seen(camera, {place}), 2 * kBox);
    // What lies behind the far plane is no hit, and shadows all the same.
    camera.znear = 0.01;
    camera.zfar = 4.4;
    expect_same_shadows(seen(camera, {place}), 2 * kBox + kSphere);
}

// Pictures of other methods depend on what is listed.
TEST(OneSide, OfExactAlone) {
    MovingTriangles scene = still_life(1);
    scene.add(spot(0.6f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    RenderSettings settings = small_settings(60, 45, 4, 128);
    for (const Method& method : methods()) {
        if (method.name == "exact") continue;
        settings.method = method.name;
        const Both both = render_both(scene, settings);
        EXPECT_EQ(hash_of(both.all), hash_of(both.one)) << method.name;
        EXPECT_EQ(both.one.stats.counts.at("closed_triangles"), 0u) << method.name;
        EXPECT_EQ(both.all.stats.counts.at("bin_entries.0"), both.one.stats.counts.at("bin_entries.0")) << method.name;
    }
}

uint64_t ranges_of_light(const Frame& frame, uint32_t light) {
    return frame.stats.counts.at("ranges." + std::to_string(light));
}

// A floor on which all stands, and a wall beside all, shadow nothing while the light is on the scene's side of them.
TEST(OneSide, NotWhatLiesOnTheHull) {
    const auto sheets = [](const glm::vec3& floor_moves) {
        MovingTriangles scene(1);
        add_quad(scene, glm::vec3(0.0f), {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, floor_moves);
        add_quad(scene, {-6.0f, 3.0f, 0.0f}, {0.0f, 3.0f, 0.0f}, {0.0f, 0.0f, 6.0f});
        add_quad(scene, {-1.0f, 1.0f, 1.5f}, {0.8f, 0.5f, 0.0f}, {0.0f, 0.5f, -0.8f}, {0.1f, 0.2f, 0.0f});
        scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
        scene.add(spot(0.9f), {at({3.0, 5.0, 1.0}, {0.0, 0.0, 0.0})});   // Before both.
        scene.add(spot(0.9f), {at({-9.0, 5.0, 1.0}, {0.0, 0.0, 0.0})});  // Behind the wall.
        scene.add(spot(0.6f), {at({1.0, -4.0, 2.0}, {0.0, 0.0, 0.0})});  // Beneath the floor.
        scene.add(spot(0.9f), {at({3.0, 1.0, 2.0}, {0.0, 0.0, 0.0}), at({3.0, -1.0, 2.0}, {0.0, 0.0, 0.0})});  // Through it.
        return scene;
    };
    const RenderSettings settings = small_settings(120, 90, 8);
    const MovingTriangles still = sheets({});
    expect_same_shadows(still, 0, settings);
    const Both both = render_both(still, settings);
    EXPECT_LT(ranges_of_light(both.one, 0) * 10, ranges_of_light(both.all, 0));
    EXPECT_GT(ranges_of_light(both.one, 1) * 20, ranges_of_light(both.all, 1));
    EXPECT_LT(ranges_of_light(both.one, 1), ranges_of_light(both.all, 1));
    EXPECT_LT(ranges_of_light(both.one, 2), ranges_of_light(both.all, 2));
    const MovingTriangles moving = sheets({0.0f, 0.1f, 0.0f});
    expect_same_shadows(moving, 0, settings);
    MovingTriangles sunny = sheets({});
    sunny.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
    sunny.add(sun(3.0f), {{glm::dvec3(0.0), looking({0.5, -1.0, -0.3})}, {glm::dvec3(0.0), looking({0.2, -1.0, 0.1})}});
    sunny.add(sun(3.0f), {{glm::dvec3(0.0), looking({0.1, 1.0, 0.2})}});
    for (const uint32_t shadow_res : {1024u, 4u, 1u}) expect_same_shadows(sunny, 0, small_settings(120, 90, 8, shadow_res));
    MovingTriangles under = sheets({});
    add_quad(under, {2.0f, -0.5f, 1.0f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0f, -0.5f});
    expect_same_shadows(under, 0, settings);
    const Both shadowed = render_both(under, settings);
    EXPECT_GT(ranges_of_light(shadowed.one, 0) * 2, ranges_of_light(shadowed.all, 0)) << "the floor shadows what lies under it";
}

TEST(OneSide, NotWhereASpotIsInside) {
    for (const bool moves : {false, true}) {
        MovingTriangles scene = still_life(1);
        const Rigid inside = at({0.55, 0.8, 0.75}, {-1.0, 0.2, 0.0});
        scene.add(spot(1.2f), {moves ? at({2.0, 3.0, 2.0}, {-1.0, 0.2, 0.0}) : inside, inside});
        expect_same_shadows(scene, 2 * kBox);
    }
}

}  // namespace
}  // namespace gnomon::test
