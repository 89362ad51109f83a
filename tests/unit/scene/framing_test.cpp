// SPDX-License-Identifier: Apache-2.0
// Bounds, and the default camera, light and ground.
#include <limits>
#include <numbers>

#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

Scene moving_triangle() {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["meshes"][0]["primitives"][0]["indices"] = gltf.accessor<uint8_t>("SCALAR", {0, 1, 2});
    const int input = gltf.accessor<float>("SCALAR", {0, 1});
    const int output = gltf.accessor<float>("VEC3", {0, 0, 0, 0, 0, -4});
    gltf.add("animations", {{"samplers", {{{"input", input}, {"output", output}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    return gltf.load();
}

TEST(Framing, BoundsOverAllPoses) {
    const Scene scene = moving_triangle();
    const Bounds bounds = bounds_of(scene, pose_scene(scene, {}, 0.0, 0.5, 1));
    EXPECT_EQ(bounds.lower, glm::vec3(0, 0, -2));
    EXPECT_EQ(bounds.upper, glm::vec3(1, 1, 0));
}

TEST(Framing, NoTrianglesAreAnError) {
    Gltf gltf;
    const Scene scene = gltf.load();
    try {
        bounds_of(scene, pose_scene(scene, {}, 0, 0, 1));
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::input);
        EXPECT_THAT(e.what(), HasSubstr("no triangles"));
    }
}

TEST(Framing, PositionsThatOverflowAreAnError) {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", {0, 0, 0, 1e30f, 0, 0, 0, 1, 0})}}}});
    gltf.doc["nodes"][0]["scale"] = {1e30, 1, 1};
    const Scene scene = gltf.load();
    EXPECT_THROW(bounds_of(scene, pose_scene(scene, {}, 0, 0, 1)), Error);
}

TEST(Framing, DefaultCameraShowsTheBox) {
    for (const double aspect : {0.25, 1.0, 16.0 / 9.0, 4.0}) {
        for (const Bounds& bounds :
             {Bounds{{-1, 0, -1}, {1, 2, 1}}, Bounds{{100, 0, -3}, {101, 50, 4}}, Bounds{{0, 0, 0}, {9, 0, 9}}}) {
            Scene scene = moving_triangle();
            std::vector<Pose> poses = pose_scene(scene, {}, 0, 1, 2);
            add_default_camera(scene, poses, bounds, aspect);
            ASSERT_EQ(scene.cameras.size(), 1u);
            const Camera& camera = scene.cameras[0];
            const Rigid& place = poses[0].cameras[0];
            double reach = 0.0;  // The farthest corner in the image, 1 at its border.
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p((corner & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                                   (corner & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                                   (corner & 4) != 0 ? bounds.upper.z : bounds.lower.z);
                const glm::dvec3 q = glm::inverse(place.rotation) * (p - place.translation);
                EXPECT_GT(-q.z, camera.znear);
                EXPECT_LT(-q.z, camera.zfar);
                const double half = -q.z * std::tan(0.5 * camera.yfov);
                reach = std::max({reach, std::abs(q.y) / half, std::abs(q.x) / (half * aspect)});
            }
            EXPECT_LE(reach, 0.9 + 1e-9);
            EXPECT_GE(reach, 0.6);
            const glm::dvec3 back = place.rotation * glm::dvec3(0, 0, 1);
            EXPECT_GT(back.z, std::abs(back.x));                                // From the front,
            EXPECT_GT(back.y, 0.1);                                             // slightly above,
            EXPECT_NEAR((place.rotation * glm::dvec3(1, 0, 0)).y, 0.0, 1e-12);  // and level.
        }
    }
}

TEST(Framing, DefaultsMoveWithNothingAndStayWhenPosedAgain) {
    Scene scene = moving_triangle();
    std::vector<Pose> poses = pose_scene(scene, {}, 0, 1, 2);
    const size_t warnings = scene.warnings.size();
    add_default_camera(scene, poses, {{0, 0, 0}, {0, 0, 0}}, 1.5);
    add_default_light(scene, poses);
    EXPECT_EQ(scene.warnings.size(), warnings + 2);
    add_ground(scene, poses, {3, 4}, -1, 10);
    poses.push_back(pose_at(scene, 0.5));
    for (const Pose& pose : poses) {
        EXPECT_EQ(pose.palette.size(), 6u);
        ASSERT_EQ(pose.cameras.size(), 1u);
        ASSERT_EQ(pose.lights.size(), 1u);
        EXPECT_EQ(pose.cameras[0].translation, poses[0].cameras[0].translation);
        EXPECT_EQ(pose.lights[0].rotation, poses[0].lights[0].rotation);
        const std::vector<glm::vec3> positions = posed_positions(scene, pose);
        EXPECT_EQ(positions[3], glm::vec3(-7, -1, 14));
        EXPECT_EQ(positions[5], glm::vec3(13, -1, -6));
    }
}

TEST(Framing, DefaultLightShinesFromTheUpperLeftFront) {
    Scene scene = moving_triangle();
    std::vector<Pose> poses = pose_scene(scene, {}, 0, 1, 1);
    add_default_light(scene, poses);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, std::numbers::pi_v<float>);
    const glm::dvec3 direction = poses[1].lights[0].rotation * glm::dvec3(0, 0, -1);
    EXPECT_GT(direction.x, 0.2);
    EXPECT_LT(direction.y, -0.5);
    EXPECT_LT(direction.z, -0.2);
}

TEST(Framing, GroundFacesUp) {
    Scene scene = moving_triangle();
    std::vector<Pose> poses = pose_scene(scene, {}, 0, 1, 1);
    add_ground(scene, poses, {0, 0}, 0, 1);
    ASSERT_EQ(scene.triangles.size(), 3u);
    const std::vector<glm::vec3> positions = posed_positions(scene, poses[1]);
    for (size_t i = 1; i < 3; ++i) {
        const uint32_t* v = scene.triangles[i].vertex;
        const glm::vec3 normal = glm::cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]);
        EXPECT_EQ(normal, glm::vec3(0, 4, 0));
        EXPECT_EQ(scene.materials[scene.triangles[i].material].base_color, glm::vec4(0.5, 0.5, 0.5, 1));
    }
}

}  // namespace
}  // namespace gnomon::test
