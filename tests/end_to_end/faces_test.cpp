// SPDX-License-Identifier: Apache-2.0
// Lights of several faces, and many lights, against the reference.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/error.hpp>
#include <iostream>
#include <numeric>

#include "methods/method.hpp"
#include "shapes.hpp"
#include "support/paths.hpp"

namespace gnomon::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Light point(float intensity = 10.0f) {
    Light light;
    light.kind = LightKind::point;
    light.intensity = intensity;
    return light;
}

// What differs is rounding, and at most one in ten thousand does.
void expect_agreement(const PosedScene& posed, const RenderSettings& settings = small_settings(120, 90, 8)) {
    const Agreement agreement = agreement_of(posed, settings);
    std::cout << agreement;
    EXPECT_GT(agreement.shadow_tests, 1000u);
    EXPECT_EQ(agreement.primary_wrong, 0u) << agreement.first_wrong;
    EXPECT_EQ(agreement.shadow_wrong, 0u) << agreement.first_wrong;
    EXPECT_GE(agreement.primary_share(), 0.9999);
    EXPECT_GE(agreement.shadow_share(), 0.9999);
}

// Light and shadow are both substantial: the test sees something.
void expect_variety(const PosedScene& posed, const RenderSettings& settings, uint32_t light, double least = 0.01) {
    const Frame frame = sampled_frame(posed, settings);
    double hits = 0, lit = 0;
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        if (frame.samples[i].triangle == SampleRecord::kMiss) continue;
        ++hits;
        lit += frame.lit(i, light) ? 1 : 0;
    }
    EXPECT_GT(hits, 0.1 * static_cast<double>(frame.samples.size()));
    EXPECT_GT(lit, least * hits);
    EXPECT_LT(lit, (1.0 - least) * hits);
}

// A room around the origin with things that move about in it, on all sides of where its light is.
MovingTriangles room(uint32_t segments = 1) {
    MovingTriangles scene(segments);
    add_box(scene, {0.2f, 0.1f, -0.1f}, {4.0f, 2.5f, 3.5f});
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 place((i & 1 ? 1.5f : -1.3f) + 0.1f * static_cast<float>(i), i & 2 ? 1.2f : -1.1f,
                              i & 4 ? 1.4f : -1.2f);
        add_box(scene, place, {0.35f, 0.3f, 0.25f}, {0.4f - 0.1f * static_cast<float>(i), 0.3f, i & 1 ? 0.5f : -0.4f});
    }
    add_sphere(scene, {2.0f, 0.1f, 0.2f}, 0.4f, 6, {-0.3f, 0.5f, 0.4f});
    add_sphere(scene, {-0.2f, -1.2f, 0.3f}, 0.3f, 6, {0.8f, 0.2f, -0.3f});
    return scene;
}

// Into the room from two of its corners.
std::vector<MovingTriangles> seen_from_both_ends(const MovingTriangles& scene) {
    MovingTriangles one = scene, other = scene;
    one.add(perspective(1.7), {at({-3.6, 2.3, 3.2}, {0.5, -0.3, -0.4})});
    other.add(perspective(1.7), {at({4.0, -2.2, -3.4}, {-0.5, 0.2, 0.4})});
    return {one, other};
}

TEST(Faces, PointLightInARoom) {
    for (MovingTriangles scene : seen_from_both_ends(room())) {
        scene.add(point(), {{{0.1, 0.2, -0.1}, {}}});
        expect_agreement(scene);
        expect_variety(scene, small_settings(120, 90, 8), 0);
    }
}

TEST(Faces, PointLightThatMovesThroughARoom) {
    for (MovingTriangles scene : seen_from_both_ends(room(3))) {
        scene.add(point(), {{{-0.8, 0.2, -0.4}, {}}, {{-0.3, 0.3, 0.4}, {}}, {{0.3, 0.0, -0.5}, {}}, {{0.8, 0.5, 0.3}, {}}});
        for (const uint32_t resolution : {32u, 512u}) expect_agreement(scene, small_settings(120, 90, 8, resolution));
        expect_variety(scene, small_settings(120, 90, 8), 0);
    }
}

// The light's own turning changes nothing, to the bit.
TEST(Faces, PointLightThatTurns) {
    MovingTriangles scene = seen_from_both_ends(room())[0];
    MovingTriangles turning = scene;
    scene.add(point(), {{{0.1, 0.2, -0.1}, {1.0, 0.0, 0.0, 0.0}}, {{0.3, 0.2, -0.2}, {1.0, 0.0, 0.0, 0.0}}});
    turning.add(point(), {{{0.1, 0.2, -0.1}, glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0))},
                          {{0.3, 0.2, -0.2}, glm::angleAxis(2.0, glm::normalize(glm::dvec3(1.0, 1.0, 0.0)))}});
    const RenderSettings settings = small_settings(60, 45, 4);
    EXPECT_EQ(hash_of(shared_renderer().render(turning.scene, turning.poses, settings)),
              hash_of(shared_renderer().render(scene.scene, scene.poses, settings)));
}

// One triangle before, below and beside the light, seen by each of its faces, and a room behind it.
TEST(Faces, TriangleThatSpansAllSix) {
    const auto with_triangle = [](glm::vec3 motion) {
        MovingTriangles scene(1);
        add_box(scene, {0.0f, 0.0f, 0.0f}, {6.0f, 6.0f, 6.0f});
        // In the plane x + y + z = -1, around (-1, -1, -1) / 3.
        const glm::vec3 u = glm::normalize(glm::vec3(1, -1, 0)), v = glm::normalize(glm::vec3(1, 1, -2));
        const glm::vec3 middle(-1.0f / 3.0f);
        scene.add({middle + 3.5f * u - 2.0f * v, middle - 3.5f * u - 2.0f * v, middle + 4.5f * v}, motion);
        scene.add(perspective(1.9), {at({5.0, 5.5, 5.2}, {-1.0, -1.2, -0.8})});
        scene.add(point(), {{{0.0, 0.0, 0.0}, {}}});
        return scene;
    };
    for (const glm::vec3& motion : {glm::vec3(0.0f), glm::vec3(0.2f, 0.5f, -0.3f)}) {
        const MovingTriangles scene = with_triangle(motion);
        for (const uint32_t resolution : {7u, 256u}) expect_agreement(scene, small_settings(120, 90, 8, resolution));
        expect_variety(scene, small_settings(120, 90, 8), 0);
    }
    // Without the room each face still has ranges: those of the triangle.
    MovingTriangles alone = with_triangle(glm::vec3(0.0f));
    alone.scene.triangles.erase(alone.scene.triangles.begin(), alone.scene.triangles.end() - 1);
    RenderSettings settings = small_settings(8, 8, 1, 64);
    settings.keep_texel_ranges = true;
    const Frame frame = shared_renderer().render(alone.scene, alone.poses, settings);
    ASSERT_EQ(frame.texel_ranges.size(), 1u);
    ASSERT_EQ(frame.texel_ranges[0].size(), 6u * 64u * 64u);
    for (size_t face = 0; face < 6; ++face) {
        const auto first = frame.texel_ranges[0].begin() + static_cast<std::ptrdiff_t>(face * 64 * 64);
        EXPECT_GT(std::accumulate(first, first + 64 * 64, 0u), 20u) << face;
    }
}

// Cameras that see nothing but a seam between faces, from a wide view down to the rounding of coordinates: floor below the
// light, where two faces meet and where three do, and what hangs across the seams.
TEST(Faces, ReceiversOnASeam) {
    for (const glm::dvec3 seam : {glm::dvec3(2.0, 0.0, 0.7), glm::dvec3(-2.0, 0.0, 0.3), glm::dvec3(0.4, 0.0, 2.0),
                                  glm::dvec3(2.0, 0.0, 2.0), glm::dvec3(-2.0, 0.0, -2.0)}) {
        for (const double half_height : {0.5, 1e-3, 1e-6, 1e-8}) {
            SCOPED_TRACE(testing::Message() << seam.x << " " << seam.z << ", " << half_height);
            MovingTriangles scene(1);
            add_floor(scene, 0.0f, 6.0f);
            // Across the way from the seam to the light for a part of the time, at several heights.
            for (int i = 0; i < 4; ++i) {
                const float height = 0.3f + 0.4f * static_cast<float>(i);
                const glm::vec3 on_way = glm::mix(glm::vec3(seam), glm::vec3(0.0f, 2.0f, 0.0f), 0.5f * height);
                const float reach = 0.12f;
                add_quad(scene, on_way + glm::vec3(-reach - 0.5f, 0.0f, -reach), {2 * reach, 0, 0}, {0, 0, 2 * reach},
                         {1.0f + 0.2f * static_cast<float>(i), 0.0f, i % 2 == 0 ? 0.1f : -0.1f});
            }
            const glm::dvec3 eye = seam + glm::dvec3(0.3, 0.8, 0.2);
            scene.add(orthographic(half_height), {at(seam + 1.5 * (eye - seam), seam)});
            scene.add(point(), {{{0.0, 2.0, 0.0}, {}}});
            const RenderSettings settings = small_settings(48, 36, 16, 100);
            expect_agreement(scene, settings);
            expect_variety(scene, settings, 0, 0.02);
        }
    }
}

// A lamp just above a vast floor, whose hits are known to a hundredth of the way to the lamp, under a roof of slivers: what
// lies beyond its face's border by rounding is still hidden by the roof.
TEST(Faces, NothingLeaksWhereTheyMeet) {
    MovingTriangles scene(1);
    add_floor(scene, 0.0f, 1000.0f);
    for (const float side : {-1.0f, 1.0f}) {
        // Edges along the border, 2e-7 m apart, up to 1e-5 m beyond it; then to the roof's end.
        float from = 0.0f;
        for (int i = 0; i <= 51; ++i) {
            const float to = i == 51 ? 0.03f : 0.005f + 2e-7f * static_cast<float>(i);
            add_face(scene, {glm::vec3(side * from, 0.005f, -0.03f), glm::vec3(side * to, 0.005f, -0.03f),
                             glm::vec3(side * to, 0.005f, 0.03f), glm::vec3(side * from, 0.005f, 0.03f)});
            from = to;
        }
    }
    Camera camera = orthographic(3e-4);
    camera.znear = 1e-4;
    for (const glm::dvec3 seam : {glm::dvec3(0.01, 0.0, 0.003), glm::dvec3(-0.01, 0.0, -0.004)}) {
        MovingTriangles seen = scene;
        seen.add(camera, {at(seam + glm::dvec3(1e-4, 0.004, 2e-4), seam)});
        seen.add(point(), {{{0.0, 0.01, 0.0}, {}}});
        for (const uint32_t resolution : {64u, 1000u}) {
            const Frame frame = sampled_frame(seen, small_settings(64, 48, 8, resolution));
            size_t lit = 0;
            for (const SampleRecord& record : frame.samples) {
                ASSERT_LT(record.triangle, 2u);
                lit += record.lit;
            }
            EXPECT_EQ(lit, 0u) << resolution;
        }
    }
}

// A light that a closed mesh swallows in the course of the shutter. Until then it counts as open, and so do not others.
TEST(Faces, LightThatAClosedMeshSwallows) {
    for (const float start : {-1.5f, -0.55f, 0.0f}) {  // Outside at first, touching, inside at first.
        SCOPED_TRACE(start);
        MovingTriangles scene = seen_from_both_ends(room())[0];
        const size_t before = scene.scene.triangles.size();
        add_sphere(scene, {0.1f + start, 0.2f, -0.1f}, 0.5f, 8, {1.5f, 0.0f, 0.0f});
        const size_t swallower = scene.scene.triangles.size() - before;
        scene.add(point(), {{{0.1, 0.2, -0.1}, {}}});
        const RenderSettings settings = small_settings(120, 90, 8);
        expect_agreement(scene, settings);
        expect_variety(scene, settings, 0);
        const Frame frame = shared_renderer().render(scene.scene, scene.poses, settings);
        // The room holds the light and the camera.
        EXPECT_EQ(frame.stats.counts.at("closed_triangles"), before - 12);
        EXPECT_GT(swallower, 0u);
        RenderSettings open = settings;
        open.closed_meshes = false;
        const Agreement same =
            compare_samples(sampled_frame(scene, settings), sampled_frame(scene, open), settings.spp, settings.seed,
                            oracle::SampleJudge(scene.scene, scene.poses, 0, settings.width, settings.height));
        EXPECT_EQ(same.shadow_wrong, 0u);
        EXPECT_LE(same.shadow_differ, same.shadow_tests / 10000);
    }
}

TEST(Faces, PointLightAmongPillars) {
    for (const uint32_t segments : {1u, 4u}) {
        PosedScene posed =
            load_posed(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes/pillars.gltf", {"0", segments});
        posed.scene.lights[0].kind = LightKind::point;  // It moves up and away, and turns.
        RenderSettings settings = small_settings(160, 120, 4, 512);
        expect_agreement(posed, settings);
        expect_variety(posed, settings, 0);
    }
}

// Full opening 170 to 180 degrees.
TEST(Faces, WideSpots) {
    for (const double half_angle : {85.0, 88.9, 89.0, 89.5, 90.0}) {
        SCOPED_TRACE(half_angle);
        for (MovingTriangles scene : seen_from_both_ends(room())) {
            const glm::dquat down = looking({0.3, -1.0, 0.2});
            Light wide = spot(static_cast<float>(half_angle * kDegree), 0.0f, 10.0f);
            scene.add(wide, {{{0.1, 0.4, -0.1}, down}, {{0.4, 0.2, 0.1}, down}});
            const RenderSettings settings = small_settings(120, 90, 8);
            expect_agreement(scene, settings);
            expect_variety(scene, settings, 0);
        }
    }
}

// Some of each kind, and more than the bits of a word.
MovingTriangles many_lights(int count) {
    MovingTriangles scene = still_life(1);
    scene.scene.lights.clear();
    for (Pose& pose : scene.poses) pose.lights.clear();
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 from(3.0 * std::sin(i + 0.3), 2.5 + 0.02 * i, 3.0 * std::cos(i + 0.3));  // No wall is edge-on to it.
        if (i % 3 == 0) scene.add(sun(), {{glm::dvec3(0.0), looking(-from)}});
        if (i % 3 == 1) scene.add(spot(0.6f), {at(from, glm::dvec3(0.0))});
        if (i % 3 == 2) scene.add(point(), {{from, {}}, {from + glm::dvec3(0.2, -0.1, 0.0), {}}});
    }
    return scene;
}

TEST(Faces, ManyLights) {
    for (const int count : {32, 33, 100}) {
        SCOPED_TRACE(count);
        const MovingTriangles scene = many_lights(count);
        const RenderSettings settings = small_settings(40, 30, 4, 64);
        expect_agreement(scene, settings);
        const Frame frame = sampled_frame(scene, settings), truth = reference_frame(scene, settings);
        EXPECT_EQ(frame.more_lit.size(), frame.samples.size() * size_t(count > 32 ? (count - 1) / 32 : 0));
        for (uint32_t light = 0; light < static_cast<uint32_t>(count); light += 31) expect_variety(scene, settings, light);
        // The channels are the means of the bits, and the colours those of the reference.
        for (const uint32_t light : {0u, 31u, static_cast<uint32_t>(count) - 1}) {
            const std::vector<float>& visibility = channel(frame, "visibility." + std::to_string(light));
            for (size_t pixel = 0; pixel < visibility.size(); ++pixel) {
                float hits = 0, lit = 0;
                for (size_t s = pixel * 4; s < pixel * 4 + 4; ++s) {
                    hits += frame.samples[s].triangle != SampleRecord::kMiss ? 1.0f : 0.0f;
                    lit += frame.samples[s].triangle != SampleRecord::kMiss && frame.lit(s, light) ? 1.0f : 0.0f;
                }
                ASSERT_FLOAT_EQ(visibility[pixel], hits > 0 ? lit / hits : 0.0f) << light;
            }
        }
        double difference = 0, sum = 0;
        for (const char* name : {"R", "G", "B"}) {
            const std::vector<float>&got = channel(frame, name), &expected = channel(truth, name);
            for (size_t i = 0; i < got.size(); ++i) {
                difference += std::abs(double{got[i]} - double{expected[i]});
                sum += double{expected[i]};
            }
        }
        EXPECT_GT(sum, 0.0);
        EXPECT_LT(difference, 2e-4 * sum);
    }
}

// However the work is cut up: budgets, layouts, pages, with what is wide, what moves and more lights than a word has bits.
TEST(Faces, SameBitsHoweverTheWorkIsCut) {
    MovingTriangles scene = seen_from_both_ends(room(2))[0];
    scene.add(point(), {{{0.1, 0.2, -0.1}, {}}, {{0.3, 0.1, 0.2}, {}}});
    scene.add(spot(static_cast<float>(90.0 * kDegree)), {{{0.1, 0.4, -0.1}, looking({0.3, -1.0, 0.2})}});
    MovingTriangles many = many_lights(40);
    for (const MovingTriangles* posed : {&scene, &many}) {
        RenderSettings settings = small_settings(64, 48, 6, 200);
        settings.pages = "all";
        settings.memory_budget = uint64_t{1} << 30;
        const uint64_t expected = hash_of(shared_renderer().render(posed->scene, posed->poses, settings));
        for (const char* layout : {"array", "linked"}) {
            for (const char* pages : {"all", "asked"}) {
                for (const uint64_t mebibytes : {6u, 64u, 256u, 1024u}) {
                    SCOPED_TRACE(testing::Message() << layout << ", " << pages << ", " << mebibytes << " MiB, "
                                                    << posed->scene.lights.size() << " lights");
                    settings.layout = layout;
                    settings.pages = pages;
                    settings.memory_budget = mebibytes << 20;
                    const Frame frame = shared_renderer().render(posed->scene, posed->poses, settings);
                    EXPECT_EQ(hash_of(frame), expected);
                    EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
                }
            }
        }
    }
}

TEST(Faces, MoreLightsThanShadingWalksAreRefused) {
    MovingTriangles scene = still_life(1);
    scene.scene.lights.resize(40'000, point());
    try {
        shared_renderer().render(scene.scene, scene.poses, small_settings(8, 8, 1));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), testing::HasSubstr("40000 lights"));
        EXPECT_THAT(error.what(), testing::HasSubstr("32766"));
    }
}

// Every method makes a map for each face. Those of texels are off by about a texel where a shadow ends.
TEST(Faces, EveryMethodHasThem) {
    MovingTriangles scene = seen_from_both_ends(room())[0];
    scene.add(point(), {{{0.1, 0.2, -0.1}, {}}});
    scene.add(spot(static_cast<float>(90.0 * kDegree)), {{{0.1, 0.4, -0.1}, looking({0.3, -1.0, 0.2})}});
    RenderSettings settings = small_settings(60, 45, 8, 160);
    const Frame exact = shared_renderer().render(scene.scene, scene.poses, settings);
    for (const Method& method : methods()) {
        SCOPED_TRACE(method.name);
        settings.method = method.name;
        settings.parameters.clear();
        if (method.name == "accumulate") settings.parameters["slices"] = 16;
        const Frame frame = shared_renderer().render(scene.scene, scene.poses, settings);
        for (const char* name : {"visibility.0", "visibility.1"}) {
            const std::vector<float>&got = channel(frame, name), &expected = channel(exact, name);
            double difference = 0;
            for (size_t i = 0; i < got.size(); ++i) difference += std::abs(double{got[i]} - double{expected[i]});
            const double mean = difference / static_cast<double>(got.size());
            std::cout << method.name << ", " << name << ": " << mean << std::endl;
            EXPECT_LT(mean, method.name == "exact" ? 1e-9 : 0.03);
        }
    }
}

}  // namespace
}  // namespace gnomon::test
