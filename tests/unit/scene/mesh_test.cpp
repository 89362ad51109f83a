// SPDX-License-Identifier: Apache-2.0
// Primitives: modes, indices, component types, sparse values, strides, morph targets.
#include <array>
#include <limits>

#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Indices = std::array<uint32_t, 3>;

std::vector<Indices> triangles_of(const Scene& scene) {
    std::vector<Indices> result;
    for (const Triangle& t : scene.triangles) result.push_back({t.vertex[0], t.vertex[1], t.vertex[2]});
    return result;
}

// Vertex i at (i, 0, 0), so that positions tell vertices apart.
std::vector<float> numbered(int count) {
    std::vector<float> values;
    for (int i = 0; i < count; ++i) values.insert(values.end(), {static_cast<float>(i), 0.0f, 0.0f});
    return values;
}

Scene with_mode(int mode, int vertices) {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", numbered(vertices))}}}, {"mode", mode}});
    return gltf.load();
}

TEST(Mesh, TrianglesWithoutIndices) {
    const Scene scene = with_mode(4, 6);
    EXPECT_THAT(triangles_of(scene), ElementsAre(Indices{0, 1, 2}, Indices{3, 4, 5}));
    EXPECT_EQ(scene.vertices.size(), 6u);
    EXPECT_EQ(scene.mesh_count, 1u);
    EXPECT_EQ(scene.vertices[4].position, glm::vec3(4, 0, 0));
    EXPECT_EQ(scene.vertices[4].normal, glm::vec3(0));
    EXPECT_EQ(scene.vertices[4].color, glm::vec4(1));
}

TEST(Mesh, StripsFlipEverySecondTriangle) {
    EXPECT_THAT(triangles_of(with_mode(5, 5)), ElementsAre(Indices{0, 1, 2}, Indices{1, 3, 2}, Indices{2, 3, 4}));
}

TEST(Mesh, FansTurnAroundTheFirstVertex) {
    EXPECT_THAT(triangles_of(with_mode(6, 5)), ElementsAre(Indices{1, 2, 0}, Indices{2, 3, 0}, Indices{3, 4, 0}));
}

TEST(Mesh, PointsAndLinesAreCounted) {
    for (int mode = 0; mode < 4; ++mode) {
        const Scene scene = with_mode(mode, 4);
        EXPECT_TRUE(scene.triangles.empty());
        EXPECT_THAT(scene.warnings, has_warning("1 primitives of points or lines are ignored"));
    }
}

TEST(Mesh, LeftoverIndicesAreCounted) {
    const Scene scene = with_mode(4, 5);
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_THAT(scene.warnings, has_warning("2 indices left over"));
    EXPECT_THAT(with_mode(5, 2).warnings, has_warning("2 indices left over"));
}

template <typename T>
void expect_indices_of_type() {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", numbered(4))}}},
                        {"indices", gltf.accessor<T>("SCALAR", {2, 1, 0, 1, 2, 3})}});
    EXPECT_THAT(triangles_of(gltf.load()), ElementsAre(Indices{2, 1, 0}, Indices{1, 2, 3}));
}

TEST(Mesh, IndicesOfAllTypes) {
    expect_indices_of_type<uint8_t>();
    expect_indices_of_type<uint16_t>();
    expect_indices_of_type<uint32_t>();
}

TEST(Mesh, DegenerateTrianglesStayAndUnusedVerticesGo) {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", numbered(10))}}},
                        {"indices", gltf.accessor<uint8_t>("SCALAR", {7, 7, 3})}});
    const Scene scene = gltf.load();
    EXPECT_THAT(triangles_of(scene), ElementsAre(Indices{1, 1, 0}));
    ASSERT_EQ(scene.vertices.size(), 2u);
    EXPECT_EQ(scene.vertices[0].position.x, 3.0f);
    EXPECT_EQ(scene.vertices[1].position.x, 7.0f);
}

TEST(Mesh, IndexOutOfRangeIsAnError) {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)}}},
                        {"indices", gltf.accessor<uint16_t>("SCALAR", {0, 1, 3})}});
    EXPECT_THAT(gltf.error(), HasSubstr("vertex index 3 is out of range: there are 3 vertices"));
}

TEST(Mesh, PrimitiveRestartIsAnError) {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", numbered(256))}}},
                        {"indices", gltf.accessor<uint8_t>("SCALAR", {0, 1, 255})}});
    EXPECT_THAT(gltf.error(), HasSubstr("primitive restart"));
}

TEST(Mesh, PositionsThatAreNotFiniteAreAnError) {
    Gltf gltf;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int positions = gltf.accessor<float>("VEC3", {0, 0, nan, 1, 0, 0, 0, nan, 0});
    gltf.add("meshes", {{"name", "Bunny"}, {"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
    gltf.add("nodes", {{"mesh", 0}});
    EXPECT_THAT(gltf.error(), HasSubstr("mesh 0 'Bunny': positions of 2 of 3 vertices are not finite"));
}

TEST(Mesh, QuantizedPositions) {
    Gltf gltf;
    gltf.add_mesh_node(
        {{"attributes", {{"POSITION", gltf.accessor<int16_t>("VEC3", {-32768, 32767, 0, 1, 2, 3, 4, 5, 6}, true)}}}});
    EXPECT_THAT(gltf.error(), HasSubstr("KHR_mesh_quantization"));
    gltf.doc["extensionsUsed"] = {"KHR_mesh_quantization"};
    gltf.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
    // The views have three numbers of two bytes, so elements of six bytes: packed, as the tests' builder does.
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.vertices[0].position, glm::vec3(-1, 1, 0));
    EXPECT_FLOAT_EQ(scene.vertices[1].position.x, 1.0f / 32767.0f);

    gltf.doc["accessors"][0]["normalized"] = false;
    EXPECT_EQ(gltf.load().vertices[2].position, glm::vec3(4, 5, 6));
}

TEST(Mesh, InterleavedAttributes) {
    Gltf gltf;
    // Position and normal of each vertex, 24 bytes; normals of length 2, 0 and one that is not finite.
    const float inf = std::numeric_limits<float>::infinity();
    const int view = gltf.view<float>({0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0, 1, 0, inf, 0, 0});
    gltf.doc["bufferViews"][0]["byteStride"] = 24;
    const json accessor = {{"bufferView", view}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3}};
    const int positions = gltf.add("accessors", accessor);
    const int normals = gltf.add("accessors", accessor);
    gltf.doc["accessors"][1]["byteOffset"] = 12;
    gltf.add_mesh_node({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.vertices[2].position, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.vertices[1].normal, glm::vec3(0));
    EXPECT_EQ(scene.vertices[2].normal, glm::vec3(0));
    EXPECT_THAT(scene.warnings, has_warning("2 normals are zero or not finite"));
}

json sparse(Gltf& gltf, const std::vector<uint16_t>& indices, const std::vector<float>& values) {
    return {{"count", indices.size()},
            {"indices", {{"bufferView", gltf.view<uint16_t>(indices)}, {"componentType", 5123}}},
            {"values", {{"bufferView", gltf.view<float>(values)}}}};
}

TEST(Mesh, SparseValuesReplaceSome) {
    Gltf gltf;
    const int positions = gltf.accessor<float>("VEC3", Gltf::kTriangle);
    gltf.doc["accessors"][0]["sparse"] = sparse(gltf, {0, 2}, {9, 8, 7, 6, 5, 4});
    gltf.add_mesh_node({{"attributes", {{"POSITION", positions}}}});
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.vertices[0].position, glm::vec3(9, 8, 7));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.vertices[2].position, glm::vec3(6, 5, 4));
}

TEST(Mesh, AccessorsWithoutViewAreZeroButForSparseValues) {
    Gltf gltf;
    const int positions = gltf.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
    gltf.doc["accessors"][0]["sparse"] = sparse(gltf, {1}, {9, 8, 7});
    const int indices = gltf.add("accessors", {{"componentType", 5125}, {"type", "SCALAR"}, {"count", 3}});
    gltf.add_mesh_node({{"attributes", {{"POSITION", positions}}}});
    gltf.add_mesh_node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.vertices[0].position, glm::vec3(0));
    EXPECT_EQ(scene.vertices[1].position, glm::vec3(9, 8, 7));
    EXPECT_THAT(triangles_of(scene), ElementsAre(Indices{0, 1, 2}, Indices{3, 3, 3}));
}

TEST(Mesh, SparseIndicesMustAscendInRange) {
    for (const std::vector<uint16_t>& indices : {std::vector<uint16_t>{0, 3}, {2, 1}, {1, 1}}) {
        Gltf gltf;
        const int positions = gltf.accessor<float>("VEC3", Gltf::kTriangle);
        gltf.doc["accessors"][0]["sparse"] = sparse(gltf, indices, {9, 8, 7, 6, 5, 4});
        gltf.add_mesh_node({{"attributes", {{"POSITION", positions}}}});
        EXPECT_THAT(gltf.error(), HasSubstr("out of range or not ascending"));
    }
}

TEST(Mesh, AccessorsMustFitTheirViews) {
    const auto error_with = [](const std::string& key, const json& value) {
        Gltf gltf;
        gltf.add_triangle();
        gltf.doc["accessors"][0][key] = value;
        return gltf.error();
    };
    EXPECT_THAT(error_with("count", 4), HasSubstr("the data end at byte 48 of a view of 36 bytes"));
    EXPECT_THAT(error_with("byteOffset", 4), HasSubstr("the data end at byte 40 of a view of 36 bytes"));
    EXPECT_THAT(error_with("byteOffset", 2147483647), HasSubstr("/accessors/0"));
    EXPECT_THAT(error_with("count", 2147483647), HasSubstr("/accessors/0"));
    EXPECT_THAT(error_with("count", -1), HasSubstr("/accessors/0/count"));
    EXPECT_THAT(error_with("byteOffset", 2), HasSubstr("not at a multiple of 4"));
    EXPECT_THAT(error_with("bufferView", 1), HasSubstr("index 1 is out of range: there are 1 buffer views"));
    EXPECT_THAT(error_with("type", "VEC9"), HasSubstr("cannot have the type"));
    EXPECT_THAT(error_with("componentType", 5130), HasSubstr("cannot have the type"));
}

TEST(Mesh, AttributesMustHaveEqualCounts) {
    Gltf gltf;
    gltf.add_mesh_node({{"attributes",
                         {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)},
                          {"NORMAL", gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1})}}}});
    EXPECT_THAT(gltf.error(), HasSubstr("/meshes/0/primitives/0/attributes/POSITION"));
}

TEST(Mesh, InstancesShareNothingButDeltas) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
    const Scene scene = gltf.load();
    EXPECT_THAT(triangles_of(scene), ElementsAre(Indices{0, 1, 2}, Indices{3, 4, 5}));
    EXPECT_THAT(positions_at(scene, 0)[4], near_to({6, 0, 0}));
}

// Two targets; the second without positions.
Gltf& with_morph(Gltf& gltf) {
    const json target0 = {{"POSITION", gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 2, 0, 0, 3})}};
    const json target1 = {{"NORMAL", gltf.accessor<float>("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0})}};
    const json target2 = {{"POSITION", gltf.accessor<float>("VEC3", {0, 8, 0, 0, 8, 0, 0, 8, 0})}};
    gltf.add_mesh_node({{"attributes", {{"POSITION", gltf.accessor<float>("VEC3", Gltf::kTriangle)}}},
                        {"targets", {target0, target1, target2}}});
    gltf.doc["meshes"][0]["weights"] = {0.5, 1.0, 0.25};
    return gltf;
}

TEST(Mesh, MorphTargetsAddUp) {
    Gltf gltf;
    const Scene scene = with_morph(gltf).load();
    const std::vector<glm::vec3> positions = positions_at(scene, 0);
    EXPECT_THAT(positions[0], near_to({0, 2, 0.5}));
    EXPECT_THAT(positions[1], near_to({1, 2, 1}));
    EXPECT_THAT(positions[2], near_to({0, 3, 1.5}));
    EXPECT_EQ(scene.morph_normals[3], glm::vec3(1, 0, 0));
}

TEST(Mesh, NodesOverrideMorphWeights) {
    Gltf gltf;
    with_morph(gltf);
    gltf.doc["nodes"].push_back({{"mesh", 0}, {"weights", {0, 0, 1}}});
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.morphs.size(), 3u);
    EXPECT_EQ(scene.morphs[1].delta_first, scene.morphs[2].delta_first);
    EXPECT_THAT(positions_at(scene, 0)[1], near_to({1, 2, 1}));
    EXPECT_THAT(positions_at(scene, 0)[4], near_to({1, 8, 0}));
}

TEST(Mesh, MorphTargetsMustFit) {
    Gltf gltf;
    with_morph(gltf).doc["meshes"][0]["weights"] = {1.0};
    EXPECT_THAT(gltf.error(), HasSubstr("/meshes/0/weights"));
    gltf.doc["meshes"][0]["weights"] = {1, 1, 1};
    gltf.doc["nodes"][0]["weights"] = {1, 1};
    EXPECT_THAT(gltf.error(), HasSubstr("/nodes/0/weights"));
    gltf.doc["nodes"][0].erase("weights");
    gltf.doc["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    EXPECT_THAT(gltf.error(), HasSubstr("same number of morph targets"));
}

TEST(Mesh, TinyFilesCannotClaimHugeGeometry) {
    Gltf gltf;
    const int positions = gltf.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2000000000}});
    gltf.add_mesh_node({{"attributes", {{"POSITION", positions}}}});
    EXPECT_THAT(gltf.error(), HasSubstr("512 MiB"));
    gltf.doc["accessors"][0]["count"] = 1000000;
    for (int i = 0; i < 100; ++i) gltf.add("nodes", {{"mesh", 0}});
    EXPECT_THAT(gltf.error(), HasSubstr("more geometry than fits 1 GiB"));
}

}  // namespace
}  // namespace gnomon::test
