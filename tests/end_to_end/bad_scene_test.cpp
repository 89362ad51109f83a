// SPDX-License-Identifier: Apache-2.0
// Scenes that are empty, flat, far away or broken, rendered with the validation layer: no crash, no message, a clear error
// where there is nothing to render. And the normal paths once with the layer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/error.hpp>
#include <limits>

#include "shapes.hpp"
#include "support/paths.hpp"
#include "support/shared_devices.hpp"

namespace gnomon::test {
namespace {

Frame render(const PosedScene& posed, uint32_t shadow_res = 64) {
    RenderSettings settings = small_settings(36, 28, 5, shadow_res);
    settings.keep_samples = true;
    return validated_renderer().render(posed.scene, posed.poses, settings);
}

uint64_t hits_of(const Frame& frame) {
    uint64_t hits = 0;
    for (const SampleRecord& record : frame.samples) hits += record.triangle != SampleRecord::kMiss;
    return hits;
}

void expect_finite(const Frame& frame) {
    for (const Channel& c : frame.channels) {
        for (const float value : c.values) ASSERT_TRUE(std::isfinite(value)) << c.name;
    }
}

void expect_refused(const PosedScene& posed, const std::string& text) {
    try {
        render(posed);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
        EXPECT_THAT(error.what(), testing::HasSubstr(text));
    }
}

// The camera and the lights of the still life, without its shapes.
MovingTriangles empty_stage() {
    MovingTriangles scene(1);
    scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
    scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
    scene.add(spot(0.5f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    return scene;
}

// The still life and a spot; every position p becomes scale * p + offset.
MovingTriangles placed(double scale, const glm::dvec3& offset) {
    MovingTriangles scene = still_life(1);
    scene.add(spot(0.5f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    for (Pose& pose : scene.poses) {
        for (size_t row = 0; row < pose.palette.size(); ++row) {
            pose.palette[row] *= static_cast<float>(scale);
            pose.palette[row].w += static_cast<float>(offset[static_cast<glm::length_t>(row % 3)]);
        }
        for (Rigid& r : pose.cameras) r.translation = scale * r.translation + offset;
        for (Rigid& r : pose.lights) r.translation = scale * r.translation + offset;
    }
    for (Camera& camera : scene.scene.cameras) camera.znear *= scale;
    return scene;
}

TEST(BadScenes, WithoutTrianglesIsAnError) { expect_refused(empty_stage(), "no triangles"); }

TEST(BadScenes, PositionsThatAreNotFiniteAreAnError) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        MovingTriangles scene = still_life(1);
        scene.scene.vertices[7].position.y = bad;
        expect_refused(scene, "not finite");
    }
}

TEST(BadScenes, TrianglesWithoutAreaAreNotSeenAndCastNoShadow) {
    MovingTriangles scene = empty_stage();
    scene.add({glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)});
    scene.add({glm::vec3(-1.0f), glm::vec3(0.0f), glm::vec3(1.0f)}, {0.5f, 0.0f, 0.0f});
    scene.add({glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f)}, {0.5f, 0.5f, 0.0f});
    EXPECT_EQ(hits_of(render(scene)), 0u);

    MovingTriangles still = still_life(1);
    const Frame before = render(still);
    still.add({glm::vec3(-1.0f, 2.0f, 0.0f), glm::vec3(0.0f, 2.0f, 0.0f), glm::vec3(1.0f, 2.0f, 0.0f)}, {0.5f, 0.0f, 0.0f});
    const Frame after = render(still);
    for (size_t i = 0; i < before.samples.size(); ++i) {
        ASSERT_EQ(before.samples[i].triangle, after.samples[i].triangle);
        ASSERT_EQ(before.samples[i].lit, after.samples[i].lit);
    }
}

TEST(BadScenes, ZeroScale) {
    MovingTriangles scene = still_life(1);
    for (Pose& pose : scene.poses) pose.palette.assign(pose.palette.size(), glm::vec4(0.0f));
    EXPECT_EQ(hits_of(render(scene)), 0u);
    // At one key only: it grows from a point.
    MovingTriangles growing = still_life(1);
    growing.poses[0].palette.assign(growing.poses[0].palette.size(), glm::vec4(0.0f));
    const Frame frame = render(growing);
    EXPECT_GT(hits_of(frame), 0u);
    expect_finite(frame);
}

TEST(BadScenes, AllBehindTheCamera) {
    MovingTriangles scene = still_life(1);
    for (Pose& pose : scene.poses) pose.cameras[0].rotation = looking({2.0, 2.9, 5.0});
    const Frame frame = render(scene);
    EXPECT_EQ(hits_of(frame), 0u);
    for (const Channel& c : frame.channels) EXPECT_THAT(c.values, testing::Each(0.0f)) << c.name;
}

TEST(BadScenes, FarAwayTinyAndLarge) {
    const uint64_t hits = hits_of(render(placed(1.0, glm::dvec3(0.0))));
    for (const auto& [scale, offset] : {std::pair(1.0, 1e6), std::pair(1e-5, 0.0), std::pair(1e5, 0.0), std::pair(1e9, 0.0)}) {
        SCOPED_TRACE(testing::Message() << "scale " << scale << ", offset " << offset);
        const Frame frame = render(placed(scale, glm::dvec3(offset, -0.5 * offset, offset)));
        expect_finite(frame);
        // At 10^6 m a float's step is 6 cm; else only rounding differs.
        EXPECT_NEAR(static_cast<double>(hits_of(frame)), static_cast<double>(hits),
                    offset > 0.0 ? 0.1 * static_cast<double>(hits) : 3.0);
    }
}

TEST(BadScenes, CoordinatesBeyondTheLimitsOfFloatAreRefused) {
    for (const double scale : {1e-30, 1e-18, 1e-14}) expect_refused(placed(scale, glm::dvec3(0.0)), "scale it up");
    for (const double scale : {1e13, 1e15, 1e20, 1e30}) expect_refused(placed(scale, glm::dvec3(0.0)), "scale it down");
}

// Under a sun, whose light does not depend on the distance, the picture is the same at any scale.
TEST(BadScenes, TheSameLightAtAnyScale) {
    const auto at_scale = [](double scale) {
        MovingTriangles scene = still_life(1);
        for (Pose& pose : scene.poses) {
            for (glm::vec4& row : pose.palette) row *= static_cast<float>(scale);
            for (Rigid& r : pose.cameras) r.translation *= scale;
        }
        for (Camera& camera : scene.scene.cameras) camera.znear *= scale;
        return render(scene);
    };
    const auto light_of = [](const Frame& frame) {
        double sum = 0.0;
        for (const float value : frame.channels[0].values) sum += static_cast<double>(value);
        return sum;
    };
    const double light = light_of(at_scale(1.0));
    ASSERT_GT(light, 0.0);
    for (const double scale : {1e-12, 1e-11, 5e9, 1e10}) EXPECT_NEAR(light_of(at_scale(scale)), light, 1e-2 * light) << scale;
}

TEST(BadScenes, LightAtASurfaceAndCameraInATriangle) {
    MovingTriangles scene = still_life(1);
    scene.add(spot(0.9f), {{{0.5, 0.0, 0.5}, looking({0.0, -1.0, 1e-3})}});
    scene.add(spot(0.9f), {{{0.5, 0.0, 0.5}, looking({1.0, 0.0, 0.0})}});
    for (Pose& pose : scene.poses) pose.cameras[0] = at({1.0, 0.0, 1.0}, {-1.0, 0.0, -1.0});
    expect_finite(render(scene));
}

// The layer is there and on: a frame in each kind of view, layout and cut of the work brings no message.
TEST(Validation, NormalFramesBringNoMessage) {
    RenderSettings settings = small_settings(70, 50, 6, 128);
    const MovingTriangles still = placed(1.0, glm::dvec3(0.0));
    for (const char* layout : {"array", "linked"}) {
        settings.layout = layout;
        const Frame frame = validated_renderer().render(still.scene, still.poses, settings);
        EXPECT_EQ(hash_of(frame), hash_of(shared_renderer().render(still.scene, still.poses, settings))) << layout;
        settings.pages = "asked";
        EXPECT_EQ(hash_of(validated_renderer().render(still.scene, still.poses, settings)), hash_of(frame)) << layout;
        settings.pages = "all";
    }
    MovingTriangles ortho = still_life(2);
    ortho.scene.cameras[0] = orthographic(2.0);
    validated_renderer().render(ortho.scene, ortho.poses, settings);
    const PosedScene figure =
        load_posed(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes/figure.gltf");  // Skin, morph-free, texture.
    const Frame whole = validated_renderer().render(figure.scene, figure.poses, settings);
    settings.memory_budget = whole.stats.peak_bytes * 9 / 10;
    EXPECT_EQ(hash_of(validated_renderer().render(figure.scene, figure.poses, settings)), hash_of(whole));
}

}  // namespace
}  // namespace gnomon::test
