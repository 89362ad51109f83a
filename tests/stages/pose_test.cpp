// SPDX-License-Identifier: Apache-2.0
// The pose stage computes the bits of posed_positions, which the oracle confirms.
#include "stages/pose.hpp"

#include <gnomon/error.hpp>
#include <limits>
#include <random>

#include "oracle/posed.hpp"
#include "stage_test.hpp"
#include "support/assets.hpp"
#include "support/paths.hpp"

namespace gnomon::test {
namespace {

class PoseTest : public StageTest {
protected:
    void expect_same_bits(const std::filesystem::path& path) {
        SCOPED_TRACE(path.string());
        const Scene scene = load_scene(path);
        ASSERT_FALSE(scene.vertices.empty());
        const std::vector<Pose> poses = pose_scene(scene, {AnimationChoice::Kind::all, 0}, 0.1, 0.35, 2);
        const Geometry geometry = pose_geometry(device(), programs(), scene, poses);
        for (size_t k = 0; k < poses.size(); ++k) {
            const std::vector<glm::vec3> expected = posed_positions(scene, poses[k]);
            const std::vector<glm::vec4> posed = gpu::download_vector<glm::vec4>(
                device(), geometry.positions, expected.size(), k * geometry.vertex_stride * sizeof(glm::vec4));
            uint64_t differing = 0;
            double largest = 1e-30, worst = 0.0;
            for (size_t v = 0; v < expected.size(); ++v) {
                differing += glm::floatBitsToUint(glm::vec3(posed[v])) != glm::floatBitsToUint(glm::vec3(expected[v])) ? 1 : 0;
                const glm::dvec3 exact = oracle::posed_position(scene, poses[k], v);
                largest = std::max(largest, glm::length(exact));
                worst = std::max(worst, glm::length(exact - glm::dvec3(posed[v])));
            }
            EXPECT_EQ(differing, 0u) << "of " << expected.size() << " vertices at key " << k;
            EXPECT_LT(worst, 1e-4 * largest);
        }
        const Bounds bounds = geometry_bounds(device(), programs(), geometry, scene, poses).all,
                     expected = bounds_of(scene, poses);
        EXPECT_EQ(bounds.lower, expected.lower);
        EXPECT_EQ(bounds.upper, expected.upper);
    }
};

TEST_F(PoseTest, OwnScenes) {
    for (const char* name : {"figure", "random-cubes", "tube"}) {
        expect_same_bits(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes" / (std::string(name) + ".gltf"));
    }
}

// A bit for each triangle, around the size of a word and of a workgroup: still are those that move at no key.
TEST_F(PoseTest, WhatStandsStill) {
    for (const uint32_t count : {1u, 31u, 32u, 33u, 64u, 65u, 1000u}) {
        for (const size_t keys : {size_t{2}, size_t{4}}) {
            Scene scene;
            scene.morphs.emplace_back();
            scene.materials.emplace_back();
            // Joint 0 stands still, joint 1 moves by an ulp, at the last key alone.
            for (uint32_t joint = 0; joint < 2; ++joint) {
                Vertex vertex;
                vertex.position = {1.0f, 2.0f, 3.0f};
                vertex.influence_first = joint;
                vertex.influence_count = 1;
                scene.influences.push_back({joint, 1.0f});
                scene.vertices.push_back(vertex);
            }
            std::mt19937 random(count);
            std::vector<bool> expected;
            for (uint32_t i = 0; i < count; ++i) {
                const auto moving = static_cast<uint32_t>(random() % 5);  // Which vertex; of 3 and 4 none.
                scene.triangles.push_back({{moving == 0 ? 1u : 0u, moving == 1 ? 1u : 0u, moving == 2 ? 1u : 0u}, 0});
                expected.push_back(moving > 2);
            }
            std::vector<Pose> poses(keys);
            for (Pose& pose : poses)
                pose.palette = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
            poses.back().palette[4].w = 2.4e-7f;
            const Geometry geometry = pose_geometry(device(), programs(), scene, poses);
            const std::vector<uint32_t> words = gpu::download_vector<uint32_t>(device(), geometry.still, (count + 31) / 32);
            std::vector<bool> found;
            for (uint32_t i = 0; i < count; ++i) found.push_back((words[i / 32] >> i % 32 & 1u) != 0);
            EXPECT_EQ(found, expected);
            EXPECT_EQ(gpu::values_of<uint32_t>(device(), geometry.still_triangles)[0],
                      std::count(expected.begin(), expected.end(), true));
        }
    }
}

// By hand: two triangles, a vertex that none uses far away, motion; then a position that is not finite.
TEST_F(PoseTest, BoundsHoldWhatTrianglesUse) {
    for (const uint32_t extra : {0u, 1u, 200u}) {
        Scene scene;
        scene.morphs.emplace_back();
        scene.materials.emplace_back();
        const glm::vec3 places[] = {{1, 2, 3}, {-4, 2, 3}, {1, 5, -6}, {100, -100, 100}};
        for (const glm::vec3& place : places) {
            Vertex vertex;
            vertex.position = place;
            vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
            vertex.influence_count = 1;
            scene.influences.push_back({0, 1.0f});
            scene.vertices.push_back(vertex);
        }
        for (uint32_t i = 0; i < extra; ++i) scene.triangles.push_back({{0, 0, 0}, 0});
        scene.triangles.push_back({{0, 1, 2}, 0});
        std::vector<Pose> poses(3);
        for (size_t k = 0; k < poses.size(); ++k)
            poses[k].palette = {{1, 0, 0, 0}, {0, 1, 0, -10.0f * static_cast<float>(k)}, {0, 0, 1, 0}};
        Geometry geometry = pose_geometry(device(), programs(), scene, poses);
        const Bounds bounds = geometry_bounds(device(), programs(), geometry, scene, poses).all;
        EXPECT_EQ(bounds.lower, glm::vec3(-4, -18, -6));
        EXPECT_EQ(bounds.upper, glm::vec3(1, 5, 3));
        poses[1].palette[2].w = std::numeric_limits<float>::infinity();
        geometry = pose_geometry(device(), programs(), scene, poses);
        EXPECT_THROW(geometry_bounds(device(), programs(), geometry, scene, poses), Error);
    }
}

// By hand: a tetrahedron and triangles of no shell take turns, then a long run of each.
TEST_F(PoseTest, BoundsOfShells) {
    Scene scene;
    scene.morphs.emplace_back();
    scene.materials.emplace_back();
    const glm::vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    for (uint32_t shell = 0; shell < 3; ++shell) {
        for (const glm::vec3& corner : corners) {
            Vertex vertex;
            vertex.position = corner + 10.0f * static_cast<float>(shell);
            vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
            vertex.influence_count = 1;
            scene.influences.push_back({0, 1.0f});
            scene.vertices.push_back(vertex);
        }
    }
    const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const auto add = [&](uint32_t shell, uint32_t face) {
        const uint32_t* f = faces[face];
        scene.triangles.push_back({{4 * shell + f[0], 4 * shell + f[1], 4 * shell + f[2]}, 0});
    };
    for (uint32_t face = 0; face < 4; ++face) {
        add(1, face);
        if (face < 3) add(0, face);  // It has a hole.
    }
    for (uint32_t i = 0; i < 500; ++i) add(0, 0);
    for (uint32_t i = 0; i < 800; ++i) {
        for (uint32_t face = 0; face < 4; ++face) add(2, face);
    }
    std::vector<Pose> poses(2);
    for (size_t k = 0; k < poses.size(); ++k)
        poses[k].palette = {{1, 0, 0, 0}, {0, 1, 0, -5.0f * static_cast<float>(k)}, {0, 0, 1, 0}};
    const Geometry geometry = pose_geometry(device(), programs(), scene, poses);
    EXPECT_EQ(geometry.scene->shell_triangles, (std::vector<uint32_t>{4, 3200, 503}));
    const GeometryBounds bounds = geometry_bounds(device(), programs(), geometry, scene, poses);
    ASSERT_EQ(bounds.shells.size(), 2u);
    for (size_t shell = 0; shell < 2; ++shell) {
        const float offset = 10.0f * static_cast<float>(shell + 1);
        EXPECT_EQ(bounds.shells[shell].lower, glm::vec3(0, -5, 0) + offset);
        EXPECT_EQ(bounds.shells[shell].upper, glm::vec3(1, 2, 3) + offset);
    }
    EXPECT_EQ(bounds.all.lower, glm::vec3(0, -5, 0));
    EXPECT_EQ(bounds.all.upper, glm::vec3(21, 22, 23));
}

class PoseAssetsTest : public PoseTest {};

TEST_F(PoseAssetsTest, SkinsAndMorphTargets) {
    GN_SKIP_WITHOUT_ASSETS();
    uint32_t found = 0;
    for (const char* name : {"CesiumMan", "Fox", "MorphStressTest", "AnimatedMorphCube", "SimpleMorph"}) {
        const std::filesystem::path folder = assets_folder() / "models" / name;
        if (!std::filesystem::is_directory(folder)) continue;
        for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) {
            const std::string type = file.path().extension().string();
            if (type != ".gltf" && type != ".glb") continue;
            expect_same_bits(file.path());
            ++found;
            break;
        }
    }
    EXPECT_GT(found, 0u) << "none of the models is in " << assets_folder();
}

}  // namespace
}  // namespace gnomon::test
