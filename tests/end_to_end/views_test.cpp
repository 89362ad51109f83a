// SPDX-License-Identifier: Apache-2.0
// Cameras and lights of every kind and in awkward places, against the reference.
#include <gtest/gtest.h>

#include <iostream>

#include "shapes.hpp"

namespace gnomon::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

void expect_agreement(const PosedScene& posed, const RenderSettings& settings = small_settings(120, 90, 8)) {
    const Agreement agreement = agreement_of(posed, settings);
    std::cout << agreement;
    EXPECT_EQ(agreement.primary_wrong, 0u) << agreement.first_wrong;
    EXPECT_EQ(agreement.shadow_wrong, 0u) << agreement.first_wrong;
    EXPECT_GE(agreement.primary_share(), 0.9999);
    EXPECT_GE(agreement.shadow_share(), 0.9998);
}

// Shares of hits, of light and of shadow are all substantial: the test sees something.
void expect_variety(const PosedScene& posed, const RenderSettings& settings, uint32_t light) {
    const Frame frame = sampled_frame(posed, settings);
    size_t hits = 0, lit = 0;
    for (const SampleRecord& record : frame.samples) {
        hits += record.triangle != SampleRecord::kMiss;
        lit += record.triangle != SampleRecord::kMiss && (record.lit >> light & 1u) != 0;
    }
    EXPECT_GT(hits, frame.samples.size() / 10);
    EXPECT_GT(lit, hits / 100);
    EXPECT_LT(lit, hits - hits / 100);
}

// The still life seen otherwise.
MovingTriangles still_life_seen(const Camera& camera, const std::vector<Rigid>& keys, uint32_t segments = 1) {
    MovingTriangles scene = still_life(segments);
    scene.scene.cameras.clear();
    for (Pose& pose : scene.poses) pose.cameras.clear();
    scene.add(camera, keys);
    return scene;
}

MovingTriangles still_life_lit(const Light& light, const std::vector<Rigid>& keys, uint32_t segments = 1) {
    MovingTriangles scene = still_life(segments);
    scene.scene.lights.clear();
    for (Pose& pose : scene.poses) pose.lights.clear();
    scene.add(light, keys);
    return scene;
}

TEST(Views, TranslatingCamera) {
    const Rigid start = at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0});
    Rigid end = start;
    end.translation += glm::dvec3(-1.5, 0.4, -1.0);
    expect_agreement(still_life_seen(perspective(0.7), {start, end}));
    expect_agreement(still_life_seen(orthographic(2.0), {start, end}));
}

TEST(Views, TranslatingSpot) {
    const Rigid start = at({2.0, 5.0, 1.0}, {0.0, 0.6, 0.0});
    Rigid end = start;
    end.translation += glm::dvec3(-2.0, 1.0, 1.0);
    const MovingTriangles scene = still_life_lit(spot(0.4f), {start, end});
    expect_agreement(scene);
    expect_variety(scene, small_settings(120, 90, 8), 0);
}

TEST(Views, OrthographicCamera) {
    const MovingTriangles scene = still_life_seen(orthographic(2.0), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
    expect_agreement(scene);
    expect_variety(scene, small_settings(120, 90, 8), 0);
}

TEST(Views, NearAndFarCutThroughTheScene) {
    for (Camera camera : {perspective(0.7), orthographic(2.0)}) {
        camera.znear = 5.2;
        camera.zfar = 6.8;
        const MovingTriangles scene = still_life_seen(camera, {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
        expect_agreement(scene);
        for (const SampleRecord& record : sampled_frame(scene, small_settings(60, 45, 8)).samples) {
            if (record.triangle == SampleRecord::kMiss) continue;
            ASSERT_GE(record.depth, 5.2f * (1.0f - 1e-6f));
            ASSERT_LE(record.depth, 6.8f * (1.0f + 1e-6f));
        }
    }
}

// The errors of K segments for K = 1, 2, 4, 8; `differing` counts samples that are wrong because a view turns.
void expect_second_order(const std::function<PosedScene(uint32_t)>& make,
                         const std::function<uint64_t(const Agreement&)>& differing) {
    std::vector<double> errors;
    for (const uint32_t segments : {1u, 2u, 4u, 8u}) {
        const Agreement agreement = agreement_of(make(segments), small_settings(160, 120, 16, 512));
        errors.push_back(static_cast<double>(differing(agreement)) / static_cast<double>(agreement.samples));
        std::cout << "segments " << segments << ": " << 100.0 * errors.back() << " % differ" << std::endl;
    }
    for (size_t i = 0; i + 1 < errors.size(); ++i)
        EXPECT_LT(errors[i + 1], errors[i] / 2.8) << "from " << (1 << i) << " segments on";
    EXPECT_GT(errors[0], 0.005) << "too little to measure";
    EXPECT_NEAR(std::log2(errors[0] / errors[3]) / 3.0, 2.0, 0.4);
}

std::vector<Rigid> turning(const Rigid& from, double angle, const glm::dvec3& axis, uint32_t segments) {
    std::vector<Rigid> keys;
    for (uint32_t k = 0; k <= segments; ++k) {
        keys.push_back({from.translation, glm::angleAxis(angle * (double(k) / segments - 0.5), axis) * from.rotation});
    }
    return keys;
}

TEST(Views, ErrorOfATurningCameraFallsWithTheSquareOfTheSegments) {
    const Rigid middle = at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0});
    expect_second_order(
        [&](uint32_t k) {
            return still_life_seen(perspective(0.7), turning(middle, 0.5, {0.0, 1.0, 0.0}, k), k);
        },
        [](const Agreement& a) { return a.primary_differ; });
}

TEST(Views, ErrorOfATurningSunFallsWithTheSquareOfTheSegments) {
    const Rigid middle{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})};
    expect_second_order(
        [&](uint32_t k) {
            return still_life_lit(sun(), turning(middle, 0.9, {0.0, 0.0, 1.0}, k), k);
        },
        [](const Agreement& a) { return a.shadow_differ; });
}

TEST(Views, FloorPassesBehindTheCamera) {
    // The camera stands on the floor's diagonal, so that triangles cross the near plane and w = 0; it moves.
    const Rigid start = at({0.5, 0.3, 0.5}, {-2.0, 0.7, -1.0});
    Rigid end = start;
    end.translation += glm::dvec3(0.3, 0.2, 0.3);
    const MovingTriangles scene = still_life_seen(perspective(1.4), {start, end});
    expect_agreement(scene);
    expect_variety(scene, small_settings(120, 90, 8), 0);
}

TEST(Views, HallOfLargeTrianglesAroundTheCamera) {
    MovingTriangles scene(1);
    add_box(scene, {0.0f, 2.0f, 0.0f}, {40.0f, 5.0f, 30.0f}, {0.5f, 0.0f, 0.2f});
    for (int i = 0; i < 8; ++i) {
        add_box(scene, {12.0f * std::sin(0.8f * float(i)), 1.0f, 9.0f * std::cos(0.8f * float(i))}, {0.5f, 2.5f, 0.5f},
                {0.0f, 0.5f, 1.0f});
    }
    const Rigid start = at({1.0, 1.0, 2.0}, {-10.0, 1.0, 3.0});
    Rigid end = start;
    end.translation += glm::dvec3(0.3, 0.2, 0.3);
    scene.add(perspective(1.6), {start, end});
    scene.add(spot(1.2f), {at({0.0, 6.0, 0.0}, {-1.0, 0.0, 0.5})});
    scene.add(sun(), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});  // Outside: the ceiling hides it.
    expect_agreement(scene);
    expect_variety(scene, small_settings(120, 90, 8), 0);
    for (const SampleRecord& record : sampled_frame(scene, small_settings(40, 30, 4)).samples) {
        ASSERT_NE(record.triangle, SampleRecord::kMiss);
    }
}

TEST(Views, GeometryBehindASpotCastsNoShadow) {
    const Rigid place = at({2.0, 4.0, 1.0}, {0.0, 0.6, 0.0});
    MovingTriangles scene = still_life_lit(spot(0.5f), {place});
    const RenderSettings settings = small_settings(120, 90, 8);
    const Frame before = sampled_frame(scene, settings);
    MovingTriangles roofed = scene;
    add_box(roofed, {3.0f, 6.0f, 1.5f}, {3.0f, 0.2f, 3.0f}, {0.0f, 0.5f, 0.0f});  // Above and behind the lamp.
    const Frame after = sampled_frame(roofed, settings);
    size_t different = 0, compared = 0;
    for (size_t i = 0; i < before.samples.size(); ++i) {
        if (before.samples[i].triangle == SampleRecord::kMiss || before.samples[i].triangle != after.samples[i].triangle)
            continue;
        ++compared;
        different += before.samples[i].lit != after.samples[i].lit;
    }
    EXPECT_GT(compared, before.samples.size() / 4);
    EXPECT_LE(different, compared / 10000);
    // Planes that pass through the lamp's own place, and triangles on both sides of it.
    add_quad(roofed, {1.5f, 3.0f, -6.0f}, {0.0f, 3.0f, 0.0f}, {0.0f, 0.0f, 12.0f}, {0.0f, 0.0f, 0.5f});
    expect_agreement(roofed);
}

TEST(Views, SpotConesFromNarrowToWide) {
    for (const double degrees : {5.0, 20.0, 45.0, 60.0, 75.0, 85.0}) {
        SCOPED_TRACE(degrees);
        const MovingTriangles scene =
            still_life_lit(spot(static_cast<float>(degrees * kDegree)),
                           {at({1.0, 3.0, 0.8}, {0.0, 0.0, 0.0}), at({0.5, 3.2, 0.8}, {-0.5, 0.2, 0.0})});
        RenderSettings settings = small_settings(120, 90, 8, 512);
        expect_agreement(scene, settings);
    }
}

TEST(Views, SeveralLightsOfBothKinds) {
    MovingTriangles scene = still_life(1);
    scene.add(spot(0.5f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    scene.add(sun(), {{glm::dvec3(0.0), looking({0.7, -0.6, 0.1})}});
    expect_agreement(scene);
    for (const uint32_t light : {0u, 1u, 2u}) expect_variety(scene, small_settings(60, 45, 8), light);
}

}  // namespace
}  // namespace gnomon::test
