// SPDX-License-Identifier: Apache-2.0
// Which boxes may reach a view's eye during the shutter.
#include "pipeline/closed.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace gnomon::test {
namespace {

Rigid looking_down_z(const glm::dvec3& place, double degrees = 0.0) {
    return {place, glm::angleAxis(degrees * std::numbers::pi / 180.0, glm::dvec3(0.0, 1.0, 0.0))};
}

// One box of half size 1, a camera with a near plane at 0.5 m and 90 degrees of view.
bool reaches(const glm::vec3& centre, const std::vector<Rigid>& keys, CameraKind kind = CameraKind::perspective,
             const glm::vec3& half = glm::vec3(1.0f)) {
    Camera camera;
    camera.kind = kind;
    camera.yfov = 0.5 * std::numbers::pi;
    camera.ymag = 2.0;
    camera.znear = 0.5;
    std::vector<Pose> poses(keys.size());
    for (size_t k = 0; k < keys.size(); ++k) poses[k].cameras = {keys[k]};
    return Eye(camera_view(camera, poses, 0, 64, 64)).may_be_reached({centre - half, centre + half});
}

TEST(ReachesEye, OfAPerspectiveView) {
    const std::vector<Rigid> still(2, looking_down_z({0, 0, 0}));
    EXPECT_TRUE(reaches({0, 0, 0}, still));
    EXPECT_FALSE(reaches({0, 0, -1.51f}, still));
    EXPECT_TRUE(reaches({0, 0, -1.49f}, still));
    EXPECT_TRUE(reaches({0, 0, 0.99f}, still));
    EXPECT_FALSE(reaches({0, 0, 1.01f}, still));
    // Beside the near plane's edge, 0.5 m from the axis.
    EXPECT_TRUE(reaches({1.49f, 0, 0}, still));
    EXPECT_FALSE(reaches({1.51f, 0, 0}, still));
    EXPECT_TRUE(reaches({0, -1.49f, 0}, still));
    EXPECT_FALSE(reaches({0, -1.51f, 0}, still));
    // Thin, and all around it.
    EXPECT_TRUE(reaches({0, 0, -0.25f}, still, CameraKind::perspective, {100, 100, 0.01f}));
    EXPECT_FALSE(reaches({0, 0, -0.75f}, still, CameraKind::perspective, {100, 100, 0.01f}));
}

TEST(ReachesEye, OfAnOrthographicView) {
    const std::vector<Rigid> still(2, looking_down_z({0, 0, 0}));
    const CameraKind kind = CameraKind::orthographic;
    EXPECT_TRUE(reaches({0, 0, -1.49f}, still, kind));
    EXPECT_FALSE(reaches({0, 0, -1.51f}, still, kind));
    EXPECT_TRUE(reaches({0, 0, 0.49f}, still, kind));
    EXPECT_FALSE(reaches({0, 0, 0.51f}, still, kind));
    EXPECT_TRUE(reaches({2.99f, 0, 0}, still, kind));
    EXPECT_FALSE(reaches({3.01f, 0, 0}, still, kind));
}

// A view that looks across a large box below it: the axes of the box tell, those of the view do not.
TEST(ReachesEye, AGroundBelowATurnedView) {
    const Rigid down{glm::dvec3(0, 1.5, 0), glm::angleAxis(-0.4, glm::normalize(glm::dvec3(1.0, 0.3, 0.1)))};
    EXPECT_FALSE(reaches({0, -1, 0}, {down, down}, CameraKind::perspective, {50, 1, 50}));
    EXPECT_TRUE(reaches({0, 0.5f, 0}, {down, down}, CameraKind::perspective, {50, 1, 50}));
}

TEST(ReachesEye, AtAnyTime) {
    // Past the box, through it, and to it in the second segment.
    EXPECT_FALSE(reaches({0, 0, 0}, {looking_down_z({2, 0, 4}), looking_down_z({2, 0, -4})}));
    EXPECT_TRUE(reaches({0, 0, 0}, {looking_down_z({0, 0, 4}), looking_down_z({0, 0, -4})}));
    EXPECT_TRUE(reaches({0, 0, 0}, {looking_down_z({0, 0, 9}), looking_down_z({0, 0, 4}), looking_down_z({0, 0, 1.4})}));
    EXPECT_FALSE(reaches({0, 0, 0}, {looking_down_z({0, 0, 9}), looking_down_z({0, 0, 4}), looking_down_z({0, 0, 1.6})}));
    // Turned by half a circle in one segment, the linear motion of its vertices passes through the eye.
    EXPECT_TRUE(reaches({0, 0, -3}, {looking_down_z({0, 0, 0}), looking_down_z({0, 0, 0}, 180.0)}));
    EXPECT_FALSE(reaches({0, 0, -3}, {looking_down_z({0, 0, 0}), looking_down_z({0, 0, 0}, 20.0)}));
}

// A spot that ends a frame inside one of two shells.
TEST(ClosedShells, AreThoseThatNoEyeReaches) {
    Scene scene;
    scene.cameras.emplace_back();
    scene.lights.resize(2);
    scene.lights[1].kind = LightKind::spot;
    std::vector<Pose> poses(2);
    for (Pose& pose : poses) {
        pose.cameras = {looking_down_z({0, 0, 9})};
        pose.lights = {looking_down_z({0, 0, 0}), looking_down_z({5, 0, 3})};
    }
    GeometryBounds bounds;
    for (const float x : {0.0f, 5.0f, 0.0f}) bounds.shells.push_back({glm::vec3(x - 1, -1, -1), glm::vec3(x + 1, 1, 1)});
    bounds.shells[2].upper.z = 9.0f;
    bounds.all = {glm::vec3(-1.0f), glm::vec3(6, 1, 9)};
    const View camera = camera_view(scene.cameras[0], poses, 0, 64, 64);
    EXPECT_EQ(closed_shells(scene, poses, bounds, camera), (std::vector<uint32_t>{1, 1, 0, 0}));
    poses[1].lights[1] = looking_down_z({5, 0, 0.5});
    EXPECT_EQ(closed_shells(scene, poses, bounds, camera), (std::vector<uint32_t>{1, 0, 0, 0}));
}

}  // namespace
}  // namespace gnomon::test
