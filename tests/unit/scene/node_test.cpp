// SPDX-License-Identifier: Apache-2.0
// Nodes: transforms, hierarchy, scenes, and the cameras and lights that they carry.
#include <chrono>
#include <numbers>

#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

const double kHalf = std::sqrt(0.5);  // sin and cos of 45 degrees: half of a quarter turn.

TEST(Node, ScaleThenRotationThenTranslation) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0].update({{"translation", {10, 20, 30}}, {"rotation", {0, 0, kHalf, kHalf}}, {"scale", {2, 3, 4}}});
    const std::vector<glm::vec3> positions = positions_at(gltf.load(), 0);
    EXPECT_THAT(positions[0], near_to({10, 20, 30}));
    EXPECT_THAT(positions[1], near_to({10, 22, 30}, 1e-5f));  // (2, 0, 0) turned by 90 degrees about Z is (0, 2, 0).
    EXPECT_THAT(positions[2], near_to({7, 20, 30}, 1e-5f));   // (0, 3, 0) becomes (-3, 0, 0).
}

TEST(Node, MatricesAreColumnMajorAndParentsApplyLast) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1};
    gltf.add("nodes", {{"children", {0}}, {"scale", {-1, 1, 0}}});
    const std::vector<glm::vec3> positions = positions_at(gltf.load(), 0);
    EXPECT_THAT(positions[1], near_to({-3, 2, 0}));
    EXPECT_THAT(positions[2], near_to({-1, 4, 0}));
}

TEST(Node, DefaultSceneElseFirstElseAll) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"].push_back({{"mesh", 0}, {"translation", {1, 0, 0}}});
    gltf.doc["nodes"].push_back({{"mesh", 0}, {"translation", {2, 0, 0}}});
    EXPECT_EQ(gltf.load().triangles.size(), 3u);
    gltf.doc["scenes"] = {{{"nodes", {2}}}, {{"nodes", {0, 1}}}};
    EXPECT_THAT(positions_at(gltf.load(), 0)[0], near_to({2, 0, 0}));
    gltf.doc["scene"] = 1;
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.node_count, 3u);
}

TEST(Node, EmptyScenesLoad) {
    Gltf gltf;
    const Scene scene = gltf.load();
    EXPECT_TRUE(scene.triangles.empty());
    EXPECT_FALSE(scene.materials.empty());
    EXPECT_EQ(pose_at(scene, 0).palette.size(), 0u);
}

TEST(Node, GraphsThatAreNoForestAreErrors) {
    Gltf gltf;
    gltf.doc["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
    EXPECT_THAT(gltf.error(), HasSubstr("is its own ancestor"));
    gltf.doc["nodes"] = json::array({{{"children", {0}}}});
    EXPECT_THAT(gltf.error(), HasSubstr("is its own ancestor"));
    gltf.doc["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, json::object()};
    EXPECT_THAT(gltf.error(), HasSubstr("node 2 has two parents"));
    gltf.doc["nodes"] = {{{"children", {1}}}, json::object()};
    gltf.doc["scenes"] = {{{"nodes", {1}}}};
    EXPECT_THAT(gltf.error(), HasSubstr("node 1 is not a root"));
}

TEST(Node, DeepHierarchies) {
    Gltf gltf;
    gltf.add_triangle();
    for (int i = 1; i < 20000; ++i) gltf.add("nodes", {{"children", {i - 1}}, {"translation", {0, 0, 1}}});
    EXPECT_THAT(positions_at(gltf.load(), 0)[1], near_to({1, 0, 19999}));
}

TEST(Node, IndicesOutOfRangeAreErrors) {
    for (const char* key : {"mesh", "skin", "camera"}) {
        Gltf gltf;
        gltf.add("nodes", {{key, 0}});
        EXPECT_THAT(gltf.error(), HasSubstr("/nodes/0/" + std::string(key)));
    }
    Gltf gltf;
    gltf.add("nodes", {{"children", {7}}});
    EXPECT_THAT(gltf.error(), HasSubstr("index 7 is out of range: there are 1 nodes, in scene.gltf: /nodes/0/children/0"));
    gltf.doc["nodes"] = {{{"children", {-1}}}};
    EXPECT_THAT(gltf.error(), HasSubstr("/nodes/0/children/0"));
    gltf.doc["nodes"] = {{{"children", {0.5}}}};
    EXPECT_THAT(gltf.error(), HasSubstr("/nodes/0/children/0"));
}

TEST(Node, WholeNumbersMayBeWrittenAsFloats) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0]["mesh"] = 0.0;
    EXPECT_EQ(gltf.load().triangles.size(), 1u);
}

TEST(Node, RotationsAreNormalizedWithAWarning) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0]["rotation"] = {0, 0, 5, 5};
    const Scene scene = gltf.load();
    EXPECT_THAT(positions_at(scene, 0)[1], near_to({0, 1, 0}));
    EXPECT_THAT(scene.warnings, has_warning("1 nodes have a rotation"));
    gltf.doc["nodes"][0]["rotation"] = {0, 0, 0, 0};
    EXPECT_THAT(gltf.error(), HasSubstr("/nodes/0/rotation"));
}

json perspective() { return {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", 1.5}}}}; }

TEST(Node, CamerasInNodeOrderAndOnlyThoseShown) {
    Gltf gltf;
    gltf.add("cameras", perspective());
    gltf.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", -3}, {"znear", 0}, {"zfar", 10}}}});
    gltf.doc["nodes"] = {{{"camera", 1}, {"name", "A"}}, {{"camera", 0}, {"name", "B"}}, {{"camera", 0}, {"name", "C"}}};
    gltf.doc["scenes"] = {{{"nodes", {2, 0}}}};
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "A");
    EXPECT_EQ(scene.cameras[0].kind, CameraKind::orthographic);
    EXPECT_EQ(scene.cameras[0].ymag, 3.0);
    EXPECT_GT(scene.cameras[0].znear, 0.0);
    EXPECT_THAT(scene.warnings, has_warning("znear 0"));
    EXPECT_THAT(scene.warnings, has_warning("negative size"));
    EXPECT_EQ(scene.cameras[1].name, "C");
    EXPECT_EQ(scene.cameras[1].node, 2);
    EXPECT_EQ(scene.cameras[1].yfov, 0.7);
    EXPECT_EQ(scene.cameras[1].aspect, 1.5);
    EXPECT_EQ(scene.cameras[1].zfar, 0.0);
    EXPECT_EQ(pose_at(scene, 0).cameras.size(), 2u);
}

TEST(Node, CamerasThatCannotSeeAreErrors) {
    const auto error_with = [](const std::string& key, const json& value) {
        Gltf gltf;
        gltf.add("cameras", perspective());
        gltf.doc["cameras"][0]["perspective"][key] = value;
        gltf.add("nodes", {{"camera", 0}});
        return gltf.error();
    };
    EXPECT_EQ(error_with("yfov", 0.5), "");
    EXPECT_THAT(error_with("yfov", 0), HasSubstr("yfov"));
    EXPECT_THAT(error_with("yfov", 3.2), HasSubstr("180 degrees"));
    EXPECT_THAT(error_with("znear", 0), HasSubstr("znear"));
    EXPECT_THAT(error_with("zfar", 0.05), HasSubstr("zfar"));
    EXPECT_THAT(error_with("zfar", "far"), HasSubstr("/cameras/0/perspective/zfar"));
}

Gltf& with_lights(Gltf& gltf) {
    gltf.doc["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf.doc["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3.5}},
        {{"type", "spot"}, {"color", {1, 0.5, 0}}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "point"}, {"range", 12}}};
    for (const int light : {2, 1, 0}) gltf.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    return gltf;
}

TEST(Node, Lights) {
    Gltf gltf;
    const Scene scene = with_lights(gltf).load();
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::point);
    EXPECT_EQ(scene.lights[0].range, 12.0f);
    EXPECT_EQ(scene.lights[0].intensity, 1.0f);
    EXPECT_EQ(scene.lights[1].kind, LightKind::spot);
    EXPECT_EQ(scene.lights[1].color, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(scene.lights[1].inner_cone, 0.1f);
    EXPECT_EQ(scene.lights[1].outer_cone, 0.5f);
    EXPECT_EQ(scene.lights[2].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[2].intensity, 3.5f);
    EXPECT_EQ(scene.lights[2].range, 0.0f);
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
}

TEST(Node, BrokenLightsAreErrors) {
    Gltf gltf;
    with_lights(gltf).doc["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 3;
    EXPECT_THAT(gltf.error(), HasSubstr("index 3 is out of range: there are 3 lights"));
    gltf.doc["nodes"] = json::array();
    json& lights = gltf.doc["extensions"]["KHR_lights_punctual"]["lights"];
    lights[1]["spot"]["innerConeAngle"] = 0.6;
    EXPECT_THAT(gltf.error(), HasSubstr("cone angles"));
    lights[1] = {{"type", "laser"}};
    EXPECT_THAT(gltf.error(), HasSubstr("laser"));
    lights[1] = {{"type", "point"}, {"intensity", -1}};
    EXPECT_THAT(gltf.error(), HasSubstr("intensity"));
}

glm::dvec3 forward(const Rigid& rigid) { return rigid.rotation * glm::dvec3(0, 0, -1); }
glm::dvec3 up(const Rigid& rigid) { return rigid.rotation * glm::dvec3(0, 1, 0); }

// The rigid motion of a camera under a parent.
Rigid camera_under(const json& parent, const json& node = json::object()) {
    Gltf gltf;
    gltf.add("cameras", perspective());
    gltf.add("nodes", node);
    gltf.doc["nodes"][0]["camera"] = 0;
    gltf.add("nodes", parent);
    gltf.doc["nodes"][1]["children"] = {0};
    return pose_at(gltf.load(), 0).cameras[0];
}

TEST(Node, NumbersBeyond32BitFloatsAreErrors) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["extensionsUsed"] = {"KHR_lights_punctual"};
    json& light = gltf.doc["extensions"]["KHR_lights_punctual"]["lights"][0];
    for (const json& broken : {json{{"intensity", 1e39}}, json{{"color", {1, 1e39, 1}}}, json{{"range", 1e39}},
                               json{{"intensity", 1e30}, {"color", {1e10, 1, 1}}}}) {
        light = {{"type", "directional"}};
        light.update(broken);
        EXPECT_THAT(gltf.error(), testing::HasSubstr("larger than a 32-bit float can hold")) << broken;
    }
    light = {{"type", "directional"}, {"intensity", 1e37}};
    gltf.doc["nodes"][0]["translation"] = {0, -1e39, 0};
    EXPECT_THAT(gltf.error(), testing::HasSubstr("/nodes/0/translation/1"));
}

// Walked up from each camera, this would take a minute.
TEST(Node, CamerasInALongChainWithoutScale) {
    constexpr int kNodes = 100'000;
    Gltf gltf;
    gltf.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
    for (int n = 0; n < kNodes; ++n) {
        json node = {{"camera", 0}, {"scale", {0, 0, 0}}};
        if (n + 1 < kNodes) node["children"] = {n + 1};
        gltf.doc["nodes"].push_back(std::move(node));
    }
    const Scene scene = gltf.load();
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(pose_at(scene, 0.0).cameras.size(), size_t{kNodes});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Node, RigidMotionsHaveNoScale) {
    const Rigid rigid = camera_under({{"scale", {2, 3, 4}}, {"rotation", {0, kHalf, 0, kHalf}}},
                                     {{"translation", {0, 0, 1}}, {"scale", {5, 5, 5}}});
    EXPECT_THAT(glm::vec3(rigid.translation), near_to({4, 0, 0}, 1e-5f));  // (0, 0, 4) turned by 90 degrees about Y.
    EXPECT_THAT(glm::vec3(forward(rigid)), near_to({-1, 0, 0}));
    EXPECT_THAT(glm::vec3(up(rigid)), near_to({0, 1, 0}));
    EXPECT_NEAR(glm::length(rigid.rotation), 1.0, 1e-12);
}

TEST(Node, MirroredRigidMotionsKeepViewAndUp) {
    const Rigid rigid = camera_under({{"scale", {-1, 1, 1}}}, {{"rotation", {0, kHalf, 0, kHalf}}});
    EXPECT_THAT(glm::vec3(forward(rigid)), near_to({1, 0, 0}));  // The mirrored view axis: (-1, 0, 0) becomes (1, 0, 0).
    EXPECT_THAT(glm::vec3(up(rigid)), near_to({0, 1, 0}));
}

TEST(Node, RigidMotionsWithZeroScaleKeepTheirRotation) {
    const Rigid rigid = camera_under({{"scale", {0, 0, 0}}, {"rotation", {kHalf, 0, 0, kHalf}}});
    EXPECT_THAT(glm::vec3(forward(rigid)), near_to({0, 1, 0}));  // -Z turned by 90 degrees about X.
    EXPECT_THAT(glm::vec3(up(rigid)), near_to({0, 0, 1}));
}

}  // namespace
}  // namespace gnomon::test
