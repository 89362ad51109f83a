// SPDX-License-Identifier: Apache-2.0
// Cases whose answer is known on paper, for the Embree reference and for the brute-force oracle alike.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "math/sample.h"
#include "moving_triangles.hpp"
#include "oracle/brute_force.hpp"
#include "reference.hpp"

namespace gnomon {
namespace {

using test::Corners;
using test::MovingTriangles;

constexpr uint32_t kSize = 24, kSpp = 8;
const glm::dquat kUpright(1.0, 0.0, 0.0, 0.0);  // A camera or light of this rotation looks along -Z.

// Covers x <= right (for |y| and |x - right| below about 10) at height z.
Corners half_plane(float right, float z) { return {{{right, -60.0f, z}, {right, 60.0f, z}, {right - 60.0f, 0.0f, z}}}; }

// Covers |x|, |y| below about 10 around (x, 0) at height z.
Corners plane(float x, float z) { return {{{x - 60.0f, -40.0f, z}, {x + 60.0f, -40.0f, z}, {x, 80.0f, z}}}; }

// Sees x and y from -0.25 to 0.25 around `eye`, along -Z, or along +Z with `turned`.
void add_camera(MovingTriangles& triangles, glm::dvec3 eye, bool turned = false) {
    Camera camera;
    camera.kind = CameraKind::orthographic;
    camera.ymag = 0.25;
    triangles.add(camera, {{eye, turned ? glm::dquat(0.0, 0.0, 1.0, 0.0) : kUpright}});
}

// A sample in the world of add_camera at the origin.
struct Sample {
    double x, y, t;
    SampleRecord record;
};

enum class Tracer { reference, fast_reference, oracle };

class HandWorked : public testing::TestWithParam<Tracer> {
protected:
    static std::vector<Sample> samples_of(const MovingTriangles& triangles) {
        ReferenceSettings settings;
        settings.width = settings.height = kSize;
        settings.spp = kSpp;
        settings.keep_samples = true;
        settings.exact = GetParam() == Tracer::reference;
        RenderSettings render;
        render.width = render.height = kSize;
        render.spp = kSpp;
        const Frame frame = GetParam() == Tracer::oracle ? oracle::brute_force_trace(triangles.scene, triangles.poses, render)
                                                         : trace_reference(triangles.scene, triangles.poses, settings);
        EXPECT_EQ(frame.samples.size(), size_t{kSize} * kSize * kSpp);
        std::vector<Sample> samples;
        for (uint32_t i = 0; i < frame.samples.size(); ++i) {
            const uint32_t pixel = i / kSpp, x = pixel % kSize, y = pixel / kSize;
            const glm::vec3 p = shared::sample_point(shared::pixel_hash(x, y, 0), x, y, i % kSpp, shared::stratum_length(kSpp));
            samples.push_back({0.25 * (2.0 * p.x / kSize - 1.0), 0.25 * (1.0 - 2.0 * p.y / kSize), p.z, frame.samples[i]});
        }
        return samples;
    }

    // Every sample, but for those that are on the border within rounding, has the answer.
    static void expect_all(const MovingTriangles& triangles, const std::function<double(const Sample&)>& distance_to_border,
                           const std::function<bool(const Sample&)>& is_right) {
        size_t checked = 0;
        for (const Sample& sample : samples_of(triangles)) {
            if (std::abs(distance_to_border(sample)) < 1e-5) continue;
            ++checked;
            ASSERT_TRUE(is_right(sample)) << "x " << sample.x << ", y " << sample.y << ", t " << sample.t << ", triangle "
                                          << sample.record.triangle << ", lit " << sample.record.lit;
        }
        EXPECT_GT(checked, size_t{kSize} * kSize * kSpp * 9 / 10);
    }
};

double no_border(const Sample&) { return 1.0; }

TEST_P(HandWorked, MoverHidesWhatIsBehindItFromItsTimeOn) {
    MovingTriangles triangles(2);
    const uint32_t back = triangles.add(plane(0.0f, 0.0f));
    const uint32_t mover = triangles.add(half_plane(-0.5f, 1.0f), {1.0f, 0.0f, 0.0f});  // Its edge is at x = t - 0.5.
    add_camera(triangles, {0.0, 0.0, 3.0});
    expect_all(
        triangles, [](const Sample& s) { return s.t - 0.5 - s.x; },
        [&](const Sample& s) {
            const bool hidden = s.t - 0.5 > s.x;
            return s.record.triangle == (hidden ? mover : back) && std::abs(s.record.depth - (hidden ? 2.0f : 3.0f)) < 1e-6f;
        });
}

TEST_P(HandWorked, MoverShadowsFromItsTimeOn) {
    MovingTriangles triangles(2);
    const uint32_t ground = triangles.add(plane(0.0f, 0.0f));
    triangles.add(half_plane(-0.5f, 1.0f), {1.0f, 0.0f, 0.0f});
    add_camera(triangles, {0.0, 0.0, 0.5});  // Below the mover.
    triangles.add(Light{}, {{{}, kUpright}});
    expect_all(
        triangles, [](const Sample& s) { return s.t - 0.5 - s.x; },
        [&](const Sample& s) { return s.record.triangle == ground && s.record.lit == (s.t - 0.5 > s.x ? 0u : 1u); });
}

TEST_P(HandWorked, SlantedLightMovesTheShadow) {
    MovingTriangles triangles(1);
    triangles.add(plane(0.0f, 0.0f));
    triangles.add(half_plane(-0.5f + 0.75f, 1.0f), {1.0f, 0.0f, 0.0f});
    add_camera(triangles, {0.0, 0.0, 0.5});
    // Light that falls by 1 and moves by -0.75 in x, as (-0.6, 0, -0.8): turned about Y by the angle of cosine 0.8.
    triangles.add(Light{}, {{{}, glm::angleAxis(std::acos(0.8), glm::dvec3(0.0, 1.0, 0.0))}});
    expect_all(
        triangles, [](const Sample& s) { return s.t - 0.5 - s.x; },
        [&](const Sample& s) { return s.record.lit == (s.t - 0.5 > s.x ? 0u : 1u); });
}

TEST_P(HandWorked, SpotShadowsWithinItsConeAndBeforeItsPlace) {
    Light spot;
    spot.kind = LightKind::spot;
    spot.outer_cone = 0.2f;  // Reaches tan(0.2) = 0.2027 far on the ground below.
    const double radius = std::tan(double{spot.outer_cone});
    for (const float occluder_z : {0.75f, 1.25f}) {
        MovingTriangles triangles(1);
        triangles.add(plane(0.0f, 0.0f));
        triangles.add(plane(0.0f, occluder_z));
        add_camera(triangles, {0.0, 0.0, 0.5});
        triangles.add(spot, {{{0.0, 0.0, 1.0}, kUpright}});
        const bool in_between = occluder_z < 1.0f;
        expect_all(
            triangles, [&](const Sample& s) { return radius - std::hypot(s.x, s.y); },
            [&](const Sample& s) { return s.record.lit == (in_between && std::hypot(s.x, s.y) < radius ? 0u : 1u); });
    }
}

TEST_P(HandWorked, MovingSpotIsWhereItIsAtTheSamplesTime) {
    Light spot;
    spot.kind = LightKind::spot;
    spot.outer_cone = 0.1f;
    const double radius = std::tan(double{spot.outer_cone});
    MovingTriangles triangles(1);
    triangles.add(plane(0.0f, 0.0f));
    triangles.add(plane(0.0f, 0.75f));
    add_camera(triangles, {0.0, 0.0, 0.5});
    triangles.add(spot, {{{-0.2, 0.0, 1.0}, kUpright}, {{0.2, 0.0, 1.0}, kUpright}});
    const auto distance = [](const Sample& s) { return std::hypot(s.x - (0.4 * s.t - 0.2), s.y); };
    expect_all(
        triangles, [&](const Sample& s) { return radius - distance(s); },
        [&](const Sample& s) { return s.record.lit == (distance(s) < radius ? 0u : 1u); });
}

TEST_P(HandWorked, TriangleDoesNotOccludeItself) {
    // Light that grazes at coordinates where float steps are coarse; and corners so far from the hits that rounding is more
    // than the tolerance at the hits.
    Corners steep = plane(0.0f, 0.0f);
    steep[2].z = 81.7f;
    steep[0].z = steep[1].z = -40.85f;
    for (const auto& [corners, eye] :
         {std::pair(plane(100.0f, 300.0f), glm::dvec3(100.0, 0.0, 302.0)), std::pair(steep, glm::dvec3(0.0, 0.0, 2.0))}) {
        MovingTriangles triangles(1);
        triangles.add(corners, {0.3f, 0.1f, 0.7f});
        add_camera(triangles, eye);
        triangles.add(Light{}, {{{}, glm::angleAxis(1.57, glm::dvec3(0.0, 1.0, 0.0))}});
        expect_all(triangles, no_border, [](const Sample& s) { return s.record.triangle == 0 && s.record.lit == 1; });
    }
}

TEST_P(HandWorked, CoincidentTriangleDoesNotOcclude) {
    MovingTriangles triangles(1);
    triangles.add(plane(3.0f, 5.0f), {0.3f, 0.1f, 0.7f});
    triangles.add(plane(3.0f, 5.0f), {0.3f, 0.1f, 0.7f});
    add_camera(triangles, {3.0, 0.0, 7.0});
    triangles.add(Light{}, {{{}, glm::angleAxis(0.9, glm::dvec3(0.0, 1.0, 0.0))}});
    expect_all(triangles, no_border, [](const Sample& s) { return s.record.triangle < 2 && s.record.lit == 1; });
}

TEST_P(HandWorked, OccludersCountFromTheToleranceOn) {
    // Around x = 8 occluders count from 8 * 2^-20 = 7.6e-6 on. The camera sees the receiver from the other side.
    for (const auto& [height, lit] : {std::pair(6e-6f, 1u), std::pair(9e-6f, 0u)}) {
        MovingTriangles triangles(1);
        triangles.add(plane(8.0f, 0.0f));
        triangles.add(plane(8.0f, height));
        add_camera(triangles, {8.0, 0.0, -1.0}, true);
        // Along the light the distance is twice the height.
        triangles.add(Light{}, {{{}, glm::angleAxis(std::numbers::pi / 3, glm::dvec3(0.0, 1.0, 0.0))}});
        expect_all(triangles, no_border,
                   [lit = lit](const Sample& s) { return s.record.triangle == 0 && s.record.lit == lit; });
    }
}

TEST_P(HandWorked, NearAndFarHideFromTheCameraOnly) {
    MovingTriangles triangles(1);
    const uint32_t ground = triangles.add(plane(0.0f, 0.0f));
    triangles.add(plane(0.0f, 1.0f));  // Nearer than znear.
    add_camera(triangles, {0.0, 0.0, 1.1});
    triangles.scene.cameras[0].znear = 0.2;
    triangles.add(Light{}, {{{}, kUpright}});
    expect_all(triangles, no_border, [&](const Sample& s) { return s.record.triangle == ground && s.record.lit == 0; });
    triangles.scene.cameras[0].zfar = 1.0;
    expect_all(triangles, no_border, [&](const Sample& s) { return s.record.triangle == SampleRecord::kMiss; });
}

TEST_P(HandWorked, TurningCameraTurnsEvenly) {
    // The camera rolls by 90 degrees; the edge of the half plane x <= 0 rolls by 90 degrees * t the other way in the image.
    MovingTriangles triangles(1);
    triangles.add(half_plane(0.0f, 0.0f));
    add_camera(triangles, {0.0, 0.0, 1.0});
    triangles.poses[1].cameras[0].rotation = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0.0, 0.0, 1.0));
    const auto world_x = [](const Sample& s) {
        const double angle = s.t * std::numbers::pi / 2;
        return s.x * std::cos(angle) - s.y * std::sin(angle);
    };
    expect_all(triangles, world_x,
               [&](const Sample& s) { return s.record.triangle == (world_x(s) < 0.0 ? 0u : SampleRecord::kMiss); });
}

TEST_P(HandWorked, PerspectiveFollowsTheVerticalField) {
    MovingTriangles triangles(1);
    triangles.add(half_plane(0.1f, 0.0f));
    Camera camera;
    camera.yfov = 2.0 * std::atan(0.25);  // At depth 1 the same as add_camera sees.
    camera.aspect = 5.0;                  // Plays no part.
    triangles.add(camera, {{{0.0, 0.0, 1.0}, kUpright}});
    expect_all(
        triangles, [](const Sample& s) { return s.x - 0.1; },
        [](const Sample& s) {
            return s.x > 0.1 ? s.record.triangle == SampleRecord::kMiss : std::abs(s.record.depth - 1.0f) < 1e-6f;
        });
}

INSTANTIATE_TEST_SUITE_P(Tracers, HandWorked, testing::Values(Tracer::reference, Tracer::fast_reference, Tracer::oracle),
                         [](const auto& tested) {
                             return tested.param == Tracer::reference        ? "reference"
                                    : tested.param == Tracer::fast_reference ? "fast"
                                                                             : "oracle";
                         });

// The R, G, B of a frame in which all pixels are alike.
glm::vec3 colour_of(const MovingTriangles& triangles) {
    ReferenceSettings settings;
    settings.width = settings.height = 4;
    settings.spp = 4;
    const Frame frame = trace_reference(triangles.scene, triangles.poses, settings);
    for (size_t i = 0; i < 3; ++i) {
        for (const float value : frame.channels[i].values) EXPECT_NEAR(value, frame.channels[i].values[0], 1e-5f);
    }
    return {frame.channels[0].values[0], frame.channels[1].values[0], frame.channels[2].values[0]};
}

void expect_near(glm::vec3 a, glm::vec3 b) {
    for (glm::length_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-4f * std::abs(b[i]) + 1e-6f);
}

constexpr float kPi = std::numbers::pi_v<float>;

TEST(ReferenceShading, DirectionalLight) {
    MovingTriangles triangles(1);
    triangles.add(plane(0.0f, 0.0f));
    add_camera(triangles, {0.0, 0.0, 1.0});
    Light light;
    light.color = {1.0f, 0.5f, 2.0f};
    light.intensity = 3.0f * kPi;
    triangles.add(light, {{{}, glm::angleAxis(std::numbers::pi / 3, glm::dvec3(0.0, 1.0, 0.0))}});  // Cosine 0.5.
    triangles.scene.materials[0].base_color = {0.2f, 0.4f, 0.6f, 1.0f};
    for (Vertex& vertex : triangles.scene.vertices) vertex.color = {0.5f, 1.0f, 1.0f, 1.0f};
    expect_near(colour_of(triangles), {0.2f * 0.5f * 3.0f * 0.5f, 0.4f * 0.5f * 3.0f * 0.5f, 0.6f * 2.0f * 3.0f * 0.5f});

    // Normals of the vertices, turned toward the viewer, instead of the triangle's: the cosine becomes 1.
    for (Vertex& vertex : triangles.scene.vertices) vertex.normal = -glm::vec3(std::sqrt(0.75f), 0.0f, 0.5f);
    expect_near(colour_of(triangles), {0.3f, 0.6f, 3.6f});

    triangles.add(plane(0.0f, 5.0f));  // Behind the camera: a shadow.
    expect_near(colour_of(triangles), glm::vec3(0.0f));
}

TEST(ReferenceShading, LightFromBehindTheSurfaceIsNotReflected) {
    MovingTriangles triangles(1);
    triangles.add(plane(0.0f, 0.0f));
    add_camera(triangles, {0.0, 0.0, 1.0});
    triangles.add(Light{}, {{{}, glm::dquat(0.0, 0.0, 1.0, 0.0)}});
    expect_near(colour_of(triangles), glm::vec3(0.0f));
}

TEST(ReferenceShading, ColourIsTheMeanOverAllSamplesAndDepthOverHits) {
    MovingTriangles triangles(1);
    triangles.add(half_plane(0.01f, 0.0f));
    add_camera(triangles, {0.0, 0.0, 1.5});
    Light light;
    light.intensity = kPi;
    triangles.add(light, {{{}, kUpright}});
    ReferenceSettings settings;
    settings.width = settings.height = 5;
    const Frame frame = trace_reference(triangles.scene, triangles.poses, settings);
    ASSERT_EQ(frame.channels[3].name, "A");
    ASSERT_EQ(frame.channels[4].name, "Z");
    for (size_t pixel = 0; pixel < 25; ++pixel) {
        const float alpha = frame.channels[3].values[pixel];
        const float whole[] = {1.0f, 1.0f, 0.56f, 0.0f, 0.0f};  // Columns are 0.1 wide; the third begins at x = -0.05.
        EXPECT_NEAR(alpha, whole[pixel % 5], pixel % 5 == 2 ? 0.2f : 0.0f);
        EXPECT_NEAR(frame.channels[0].values[pixel], alpha, 1e-6f);
        EXPECT_NEAR(frame.channels[4].values[pixel], alpha > 0.0f ? 1.5f : 0.0f, 1e-6f);
    }
    EXPECT_LT(frame.channels[3].values[2], 1.0f);
}

TEST(ReferenceShading, SpotLight) {
    MovingTriangles triangles(1);
    triangles.add(plane(0.0f, 0.0f));
    add_camera(triangles, {0.0, 0.0, 1.0});
    triangles.scene.cameras[0].ymag = 1e-6;
    Light spot;
    spot.kind = LightKind::spot;
    spot.intensity = 8.0f * kPi;
    spot.inner_cone = 0.3f;
    spot.outer_cone = 0.6f;
    triangles.add(spot, {{{0.0, 0.0, 2.0}, kUpright}});
    expect_near(colour_of(triangles), glm::vec3(8.0f / 4.0f));

    triangles.scene.lights[0].range = 4.0f;  // The window is 1 - (2 / 4)^4.
    expect_near(colour_of(triangles), glm::vec3(2.0f * 15.0f / 16.0f));

    // The axis 0.5 radians off: within the smooth border, squared.
    triangles.scene.lights[0].range = 0.0f;
    for (Pose& pose : triangles.poses) pose.lights[0].rotation = glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0));
    const float cone = (std::cos(0.5f) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    expect_near(colour_of(triangles), glm::vec3(2.0f * cone * cone));

    for (Pose& pose : triangles.poses) pose.lights[0].rotation = glm::angleAxis(0.7, glm::dvec3(0.0, 1.0, 0.0));
    expect_near(colour_of(triangles), glm::vec3(0.0f));
}

TEST(ReferenceShading, TexturesAreDecodedAndWrapped) {
    MovingTriangles triangles(1);
    triangles.add(plane(0.0f, 0.0f));
    add_camera(triangles, {0.0, 0.0, 1.0});
    Light light;
    light.intensity = kPi;
    triangles.add(light, {{{}, kUpright}});
    Image image;
    image.width = 2;
    image.height = 2;
    image.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 188, 188, 188, 255};
    triangles.scene.images.push_back(image);
    triangles.scene.materials[0].image = 0;
    const auto colour_at = [&](glm::vec2 uv, Wrap wrap) {
        for (Vertex& vertex : triangles.scene.vertices) vertex.uv = uv;
        triangles.scene.materials[0].wrap_u = triangles.scene.materials[0].wrap_v = wrap;
        return colour_of(triangles);
    };
    expect_near(colour_at({0.25f, 0.25f}, Wrap::repeat), {1.0f, 0.0f, 0.0f});
    expect_near(colour_at({0.25f, 0.75f}, Wrap::repeat), {0.0f, 0.0f, 1.0f});
    expect_near(colour_at({0.75f, 0.75f}, Wrap::repeat), glm::vec3(0.502886f));  // sRGB 188 / 255.
    expect_near(colour_at({0.5f, 0.25f}, Wrap::repeat), {0.5f, 0.5f, 0.0f});
    expect_near(colour_at({0.0f, 0.25f}, Wrap::repeat), {0.5f, 0.5f, 0.0f});
    expect_near(colour_at({0.0f, 0.25f}, Wrap::clamp_to_edge), {1.0f, 0.0f, 0.0f});
    expect_near(colour_at({-1.25f, 0.25f}, Wrap::repeat), {0.0f, 1.0f, 0.0f});
    expect_near(colour_at({-0.25f, 0.25f}, Wrap::mirrored_repeat), {1.0f, 0.0f, 0.0f});
    expect_near(colour_at({1.25f, 0.25f}, Wrap::mirrored_repeat), {0.0f, 1.0f, 0.0f});
}

}  // namespace
}  // namespace gnomon
