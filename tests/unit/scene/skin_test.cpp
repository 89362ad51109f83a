// SPDX-License-Identifier: Apache-2.0
// Skins: joints, weights, inverse bind matrices.
#include <limits>

#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

// Joints 0 at (10, 0, 0) and 1 at (0, 100, 0), neither turned; the triangle's node 2 stands elsewhere. No inverse bind
// matrices.
Gltf& with_skin(Gltf& gltf, const std::vector<float>& weights,
                const std::vector<uint8_t>& joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}) {
    gltf.doc["nodes"] = {{{"translation", {10, 0, 0}}}, {{"translation", {0, 100, 0}}}};
    gltf.add_mesh_node({{"attributes",
                         {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)},
                          {"JOINTS_0", gltf.accessor<uint8_t>("VEC4", joints)},
                          {"WEIGHTS_0", gltf.accessor<float>("VEC4", weights)}}}});
    gltf.doc["nodes"][2].update({{"skin", 0}, {"translation", {-7, -7, -7}}});
    gltf.add("skins", {{"joints", {0, 1}}});
    return gltf;
}

TEST(Skin, BlendsJointsAndIgnoresTheMeshNode) {
    Gltf gltf;
    const Scene scene = with_skin(gltf, {1, 0, 0, 0, 0, 1, 0, 0, 0.75, 0.25, 0, 0}).load();
    const std::vector<glm::vec3> positions = positions_at(scene, 0);
    EXPECT_THAT(positions[0], near_to({10, 0, 0}));
    EXPECT_THAT(positions[1], near_to({1, 100, 0}));
    EXPECT_THAT(positions[2], near_to({7.5, 26, 0}));
    EXPECT_EQ(scene.skin_count, 1u);
    EXPECT_EQ(scene.vertices[0].influence_count, 1u);
    EXPECT_EQ(scene.vertices[2].influence_count, 2u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Skin, InverseBindMatricesApplyFirst) {
    Gltf gltf;
    with_skin(gltf, {1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    gltf.doc["skins"][0]["inverseBindMatrices"] = gltf.accessor<float>(
        "MAT4", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 1, 1, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -50, 0, 1});
    const std::vector<glm::vec3> positions = positions_at(gltf.load(), 0);
    EXPECT_THAT(positions[0], near_to({11, 1, 1}));
    EXPECT_THAT(positions[1], near_to({1, 50, 0}));
}

TEST(Skin, InverseBindMatricesMustFit) {
    Gltf gltf;
    with_skin(gltf, std::vector<float>(12, 0.25f));
    gltf.doc["skins"][0]["inverseBindMatrices"] = gltf.accessor<float>("MAT4", std::vector<float>(16, 0.0f));
    EXPECT_THAT(gltf.error(), HasSubstr("1 inverse bind matrices for 2 joints"));
    gltf.doc["skins"][0]["inverseBindMatrices"] = 0;
    EXPECT_THAT(gltf.error(), HasSubstr("4 x 4 float"));
}

TEST(Skin, SkewedInverseBindMatricesAreRepairedWithAWarning) {
    Gltf gltf;
    with_skin(gltf, {1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    std::vector<float> matrices(32, 0.0f);
    for (size_t i = 0; i < 32; i += 16) matrices[i] = matrices[i + 5] = matrices[i + 10] = matrices[i + 15] = 1.0f;
    matrices[15] = 2.0f;
    gltf.doc["skins"][0]["inverseBindMatrices"] = gltf.accessor<float>("MAT4", matrices);
    const Scene scene = gltf.load();
    EXPECT_THAT(positions_at(scene, 0)[0], near_to({10, 0, 0}));
    EXPECT_THAT(scene.warnings, has_warning("1 inverse bind matrices"));
}

TEST(Skin, WeightsAreNormalized) {
    Gltf gltf;
    const Scene scene = with_skin(gltf, {2, 0, 0, 0, 1, 3, 0, 0, 0.1f, 0.1f, 0, 0}).load();
    EXPECT_EQ(scene.influences[0].weight, 1.0f);
    EXPECT_EQ(scene.influences[1].weight, 0.25f);
    EXPECT_EQ(scene.influences[2].weight, 0.75f);
    EXPECT_EQ(scene.influences[3].weight, 0.5f);
}

TEST(Skin, BadWeightsCountAsZero) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Gltf gltf;
    const Scene scene =
        with_skin(gltf, {nan, 1, 0, 0, -1, 1, 0, 0, nan, nan, 0, 0}, {0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}).load();
    const std::vector<glm::vec3> positions = positions_at(scene, 0);
    EXPECT_THAT(positions[0], near_to({0, 100, 0}));
    EXPECT_THAT(positions[1], near_to({1, 100, 0}));
    EXPECT_THAT(positions[2], near_to({0, 101, 0}));  // Without any weight: its first joint, 1.
    EXPECT_THAT(scene.warnings, has_warning("4 joint weights are negative or not finite"));
    EXPECT_THAT(scene.warnings, has_warning("1 vertices have no joint weight"));
}

TEST(Skin, NormalizedIntegerWeightsAndMoreThanFourJoints) {
    Gltf gltf;
    with_skin(gltf, std::vector<float>(12, 0.0f));
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = gltf.accessor<uint16_t>("VEC4", {65535, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, true);
    attributes["JOINTS_1"] = gltf.accessor<uint16_t>("VEC4", {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1});
    attributes["WEIGHTS_1"] = gltf.accessor<uint8_t>("VEC4", {0, 0, 0, 0, 255, 0, 0, 0, 0, 51, 0, 204}, true);
    const std::vector<glm::vec3> positions = positions_at(gltf.load(), 0);
    EXPECT_THAT(positions[0], near_to({10, 0, 0}));
    EXPECT_THAT(positions[1], near_to({1, 100, 0}));
    EXPECT_THAT(positions[2], near_to({2, 81, 0}, 1e-5f));
}

TEST(Skin, JointsOutOfRangeAreAnErrorUnlessWeightless) {
    Gltf gltf;
    with_skin(gltf, {1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, {0, 9, 0, 0, 0, 9, 0, 0, 0, 2, 0, 0});
    EXPECT_THAT(gltf.error(), HasSubstr("joint 2 of a vertex of node 2 is out of range: its skin has 2 joints"));
    Gltf weightless;
    with_skin(weightless, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {0, 9, 0, 0, 0, 9, 0, 0, 0, 2, 0, 0});
    EXPECT_EQ(weightless.error(), "");
}

TEST(Skin, JointsAndWeightsComeTogether) {
    Gltf gltf;
    with_skin(gltf, std::vector<float>(12, 0.25f)).doc["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    EXPECT_THAT(gltf.error(), HasSubstr("JOINTS_0 and WEIGHTS_0 must come together"));
}

TEST(Skin, JointsMustBeNodes) {
    Gltf gltf;
    with_skin(gltf, std::vector<float>(12, 0.25f)).doc["skins"][0]["joints"] = {0, 3};
    EXPECT_THAT(gltf.error(), HasSubstr("/skins/0/joints/1"));
}

TEST(Skin, SkinsOfOneMeshDiffer) {
    Gltf gltf;
    with_skin(gltf, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    gltf.add("nodes", {{"mesh", 0}, {"skin", gltf.add("skins", {{"joints", {1, 0}}})}});
    gltf.add("nodes", {{"mesh", 0}});
    const Scene scene = gltf.load();
    const std::vector<glm::vec3> positions = positions_at(scene, 0);
    EXPECT_THAT(positions[0], near_to({10, 0, 0}));
    EXPECT_THAT(positions[3], near_to({0, 100, 0}));
    EXPECT_THAT(positions[6], near_to({0, 0, 0}));  // Without a skin the joints play no part.
    EXPECT_EQ(pose_at(scene, 0).palette.size(), 3u * 5u);
}

TEST(Skin, PrimitivesWithoutJointsFollowTheirNode) {
    Gltf gltf;
    with_skin(gltf, std::vector<float>(12, 0.25f));
    json& attributes = gltf.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes.erase("WEIGHTS_0");
    attributes.erase("JOINTS_0");
    const Scene scene = gltf.load();
    EXPECT_THAT(positions_at(scene, 0)[0], near_to({-7, -7, -7}));
    EXPECT_THAT(scene.warnings, has_warning("1 skinned primitives have no joints"));
}

}  // namespace
}  // namespace gnomon::test
