// SPDX-License-Identifier: Apache-2.0
// The faces of a light: which there are, where they look, and that what belongs to one is seen by it.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "pipeline/closed.hpp"
#include "pipeline/light_records.hpp"
#include "shared/light.h"
#include "views/view.hpp"

namespace gnomon::test {
namespace {

constexpr uint32_t kResolution = 200;
constexpr double kDegree = std::numbers::pi / 180.0;

Light light_of(LightKind kind, double outer_cone = 0.5) {
    Light light;
    light.kind = kind;
    light.outer_cone = static_cast<float>(outer_cone);
    return light;
}

std::vector<View> faces_of(const Light& light, const std::vector<Rigid>& keys) {
    std::vector<Pose> poses(keys.size());
    for (size_t k = 0; k < keys.size(); ++k) poses[k].lights = {keys[k]};
    return light_faces(light, poses, 0, {glm::vec3(-8), glm::vec3(8)}, kResolution);
}

std::vector<View> faces_at(const Light& light, const Rigid& place) { return faces_of(light, {place, place}); }

glm::dvec4 raster(const View& view, size_t key, const glm::dvec3& p) {
    const ViewKey& k = view.keys[key];
    const glm::dvec4 q(p - glm::dvec3(k.origin), 1.0);
    return {glm::dot(glm::dvec4(k.row_x), q), glm::dot(glm::dvec4(k.row_y), q), glm::dot(glm::dvec4(k.row_z), q),
            glm::dot(glm::dvec4(k.row_w), q)};
}

TEST(Faces, AreAsManyAsItTakes) {
    const Rigid place{{1, 2, 3}, {}};
    const auto count = [&](const Light& light) { return faces_at(light, place).size(); };
    EXPECT_EQ(count(light_of(LightKind::directional)), 1u);
    EXPECT_EQ(count(light_of(LightKind::spot)), 1u);
    EXPECT_EQ(count(light_of(LightKind::spot, 88.9 * kDegree)), 1u);
    EXPECT_EQ(count(light_of(LightKind::spot, 89.1 * kDegree)), 5u);
    EXPECT_EQ(count(light_of(LightKind::spot, 90.0 * kDegree)), 5u);
    EXPECT_EQ(count(light_of(LightKind::point)), 6u);
    EXPECT_EQ(faces_at(light_of(LightKind::spot), place)[0].projection(), shared::kPerspectiveView);
    EXPECT_EQ(faces_at(light_of(LightKind::directional), place)[0].projection(), shared::kOrthographicView);
    EXPECT_EQ(faces_at(light_of(LightKind::point), place)[0].projection(), shared::kFaceView);
}

// Worked out by hand. Of (2, 1, 0.5) from the light: +x looks with +y up and +z to its right; y goes down in raster space.
TEST(Faces, LookAlongTheAxesOfTheWorld) {
    const glm::dvec3 light(1, 2, 3);
    const std::vector<View> faces =
        faces_at(light_of(LightKind::point), {light, glm::angleAxis(1.0, glm::normalize(glm::dvec3(1, 2, 3)))});
    ASSERT_EQ(faces.size(), 6u);
    struct Seen {
        uint32_t face;
        glm::dvec3 from_light, expected;  // Across and down by the texel, over the depth; the depth.
    };
    for (const Seen& seen : {Seen{0, {2, 1, 0.5}, {0.25, -0.5, 2}}, Seen{1, {-2, 1, 0.5}, {0.5, -0.25, 2}},
                             Seen{2, {1, 2, 0.5}, {0.5, -0.25, 2}}, Seen{3, {1, -2, 0.5}, {0.25, -0.5, 2}},
                             Seen{4, {1, 0.5, 2}, {0.25, -0.5, 2}}, Seen{5, {1, 0.5, -2}, {0.5, -0.25, 2}}}) {
        SCOPED_TRACE(seen.face);
        const View& view = faces[seen.face];
        EXPECT_EQ(view.face, seen.face);
        const glm::dvec4 p = raster(view, 0, light + seen.from_light);
        EXPECT_NEAR(p.x / p.w, seen.expected.x * 100.0, 0.01);
        EXPECT_NEAR(p.y / p.w, seen.expected.y * 100.0, 0.01);
        EXPECT_NEAR(p.w, seen.expected.z, 1e-6);
        EXPECT_NEAR(p.z / p.w, -0.5, 1e-6);
    }
}

// All turn a triangle the same way round, as a spot's view does: orientation is not a matter of the face.
TEST(Faces, AreRightHanded) {
    for (const View& view : faces_at(light_of(LightKind::point), {})) {
        const glm::dvec3 x(glm::vec3(view.keys[0].row_x)), y(glm::vec3(view.keys[0].row_y)), w(glm::vec3(view.keys[0].row_w));
        EXPECT_NEAR(glm::dot(glm::cross(x, y), w), 100.0 * 100.0, 1.0);
    }
    const View spot = faces_at(light_of(LightKind::spot), {})[0];
    EXPECT_GT(glm::dot(glm::cross(glm::vec3(spot.keys[0].row_x), glm::vec3(spot.keys[0].row_y)), glm::vec3(spot.keys[0].row_w)),
              0.0f);
}

// The face that a direction belongs to has it in its map; also on edges, at corners and a rounding beside them.
TEST(Faces, HoldWhatBelongsToThem) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto check = [&](const std::vector<View>& faces, const Rigid& place, const glm::dvec3& d) {
        const uint32_t face = shared::face_of(glm::vec3(d));
        size_t holders = 0;
        for (const View& view : faces) {
            if (view.face != face) continue;
            ++holders;
            const glm::dvec4 p = raster(view, 1, place.translation + place.rotation * d);
            EXPECT_GT(p.w, 0.0);
            EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 0.5 * kResolution * p.w);
        }
        EXPECT_EQ(holders, 1u) << face;
    };
    const Rigid still{{0.3, -0.2, 0.7}, {1.0, 0.0, 0.0, 0.0}};
    const Rigid turned{{0.3, -0.2, 0.7}, glm::angleAxis(0.8, glm::normalize(glm::dvec3(1, -2, 0.5)))};
    const std::vector<View> point = faces_of(light_of(LightKind::point), {turned, turned});
    const std::vector<View> half = faces_of(light_of(LightKind::spot, 90.0 * kDegree), {turned, turned});
    for (int i = 0; i < 20'000; ++i) {
        glm::dvec3 d(normal(random), normal(random), normal(random));
        const auto a = static_cast<glm::length_t>(i % 3), b = (a + 1) % 3, c = (a + 2) % 3;
        if (i % 4 > 0) d[b] = (i % 8 < 4 ? d[a] : -d[a]) * (1.0 + (i % 5 - 2) * 1e-7);
        if (i % 4 > 1) d[c] = (i % 16 < 8 ? d[a] : -d[a]) * (1.0 + (i % 7 - 3) * 1e-7);
        check(point, still, d);
        d.z = -std::abs(d.z);  // Where a spot of 90 degrees shines.
        check(half, turned, d);
    }
}

TEST(Faces, MoveWithTheLightAndTurnWithASpot) {
    const glm::dquat quarter = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0, 1, 0));  // -z becomes -x.
    const std::vector<Rigid> keys = {{{0, 0, 0}, {1.0, 0.0, 0.0, 0.0}}, {{5, 0, 0}, quarter}};
    const auto forward = [&](LightKind kind) {
        for (const View& view : faces_of(light_of(kind, 90.0 * kDegree), keys)) {
            if (view.face == 5) return view;
        }
        return View();
    };
    const View point = forward(LightKind::point), spot = forward(LightKind::spot);
    EXPECT_NEAR(raster(point, 0, {0, 0, -2}).w, 2.0, 1e-6);
    EXPECT_NEAR(raster(point, 1, {5, 0, -2}).w, 2.0, 1e-6);
    EXPECT_NEAR(raster(spot, 0, {0, 0, -2}).w, 2.0, 1e-6);
    EXPECT_NEAR(raster(spot, 1, {3, 0, 0}).w, 2.0, 1e-6);
}

TEST(Faces, RecordsOfPointLightsHaveNoConeAndDoNotTurn) {
    Scene scene;
    scene.lights = {light_of(LightKind::point)};
    scene.lights[0].intensity = 3.0f;
    scene.lights[0].range = 7.0f;
    std::vector<Pose> poses(2);
    for (Pose& pose : poses) pose.lights = {{{1, 2, 3}, glm::angleAxis(1.0, glm::dvec3(0, 1, 0))}};
    const std::vector<glm::vec4> records = light_records(scene, poses);
    ASSERT_EQ(records.size(), shared::light_record(1, 2));
    EXPECT_EQ(glm::vec3(records[0]), glm::vec3(3.0f));
    EXPECT_EQ(records[1], glm::vec4(0, 1, 7, 0));
    EXPECT_EQ(records[shared::light_key(0, 1, 2)], glm::vec4(1, 2, 3, 0));
    EXPECT_EQ(records[shared::light_key(0, 1, 2) + 1], glm::vec4(0, 0, 0, 1));
}

// On whatever side of the light it comes near.
TEST(Faces, ShellsNearAPointLightAreNotClosed) {
    const std::vector<Rigid> keys(2, {{0, 0, 0}, {}});
    const View face = faces_of(light_of(LightKind::point), keys)[0];
    const double near = -1.0 / double{face.depth_near};
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto reaches = [&](double distance) {
                glm::vec3 centre(0.0f);
                centre[axis] = side * static_cast<float>(distance + 1e-3);
                return Eye(face).may_be_reached({centre - 1e-3f, centre + 1e-3f});
            };
            EXPECT_TRUE(reaches(-1e-4));
            EXPECT_TRUE(reaches(0.9 * near));
            EXPECT_FALSE(reaches(1.2 * near + 1e-7));
        }
    }
}

}  // namespace
}  // namespace gnomon::test
