// SPDX-License-Identifier: Apache-2.0
// The made scenes as gnomon sees them: sizes, closed meshes, motion, feet on the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/error.hpp>
#include <gnomon/scene.hpp>
#include <scenes/scene_makers.hpp>
#include <set>
#include <string>
#include <vector>

#include "folder.hpp"
#include "scene_checks.hpp"

namespace gnomon::makers {
namespace {

class FigureSizes : public testing::TestWithParam<uint32_t> {};

TEST_P(FigureSizes, IsClosedAndAsLargeAsAskedFor) {
    const Folder folder;
    make_figure(folder / "figure.gltf", {.triangles = GetParam()});
    const Scene scene = load_scene(folder / "figure.gltf");
    EXPECT_NEAR(static_cast<double>(scene.triangles.size()), GetParam(), 0.1 * GetParam());
    for (const char* material : {"figure", "pinwheel", "stick", "ball"}) expect_closed(scene, material);
}

TEST_P(FigureSizes, FeetAreOnTheGroundAtAllTimes) {
    const Folder folder;
    make_figure(folder / "figure.gltf", {.triangles = GetParam()});
    const Scene scene = load_scene(folder / "figure.gltf");
    const std::vector<Triangle> body = triangles_of(scene, "figure");
    // A step that is no multiple of the key frames'.
    for (const Pose& pose : pose_scene(scene, kFirstAnimation, 0.0, 1.0, GetParam() > 50000 ? 101 : 997)) {
        const auto positions = posed_positions(scene, pose);
        float lowest = 1.0f;
        for (const Triangle& t : body) {
            for (const uint32_t v : t.vertex) lowest = std::min(lowest, positions[v].y);
        }
        ASSERT_NEAR(lowest, 0.0f, 1e-3f) << "at " << pose.seconds << " s";
    }
}

INSTANTIATE_TEST_SUITE_P(Makers, FigureSizes, testing::Values(2000u, 12000u, 90000u));

TEST(Figure, WalksOneCycleAndMovesInTheFirstShutter) {
    const Folder folder;
    make_figure(folder / "figure.gltf");
    const Scene scene = load_scene(folder / "figure.gltf");
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_DOUBLE_EQ(scene.animations[0].start, 0.0);
    EXPECT_DOUBLE_EQ(scene.animations[0].end, 1.0);
    EXPECT_EQ(scene.skin_count, 1u);
    ASSERT_EQ(scene.cameras.size(), 1u);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].name, "key");
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_GT(largest(displacements(scene, "figure")), 0.03);
    EXPECT_GT(largest(displacements(scene, "pinwheel")), 0.08);
    EXPECT_GT(largest(displacements(scene, "ball")), 0.02);
    EXPECT_EQ(largest(displacements(scene, "floor")), 0.0);

    // After a cycle the limbs are as they were, one stride ahead.
    const auto cycle = pose_scene(scene, kFirstAnimation, 0.0, 1.0, 1);
    const auto start = posed_positions(scene, cycle[0]), end = posed_positions(scene, cycle[1]);
    const uint32_t first = triangles_of(scene, "figure")[0].vertex[0];
    const glm::vec3 stride = end[first] - start[first];
    EXPECT_NEAR(stride.x, 1.25f, 1e-3f);
    for (const Triangle& t : triangles_of(scene, "figure")) {
        for (const uint32_t v : t.vertex) ASSERT_LT(glm::length(end[v] - start[v] - stride), 2e-3f);
    }
}

TEST(Figure, CheckerIsDecodedAsItWasDrawn) {
    const Folder folder;
    make_figure(folder / "figure.gltf");
    const Scene scene = load_scene(folder / "figure.gltf");
    ASSERT_EQ(scene.images.size(), 1u);
    const Image& image = scene.images[0];
    ASSERT_EQ(image.width, 64u);
    ASSERT_EQ(image.height, 64u);
    const auto texel = [&](std::size_t x, std::size_t y) {
        const uint8_t* rgba = &image.rgba[4 * (y * 64 + x)];
        return std::array<int, 4>{rgba[0], rgba[1], rgba[2], rgba[3]};
    };
    EXPECT_EQ(texel(0, 5), (std::array<int, 4>{186, 181, 170, 255}));
    EXPECT_EQ(texel(5, 5), (std::array<int, 4>{226, 221, 210, 255}));
    EXPECT_EQ(texel(40, 5), (std::array<int, 4>{210, 205, 194, 255}));
    EXPECT_EQ(texel(63, 63), (std::array<int, 4>{226, 221, 210, 255}));
}

TEST(Figure, FillLightCanBeLeftOut) {
    const Folder folder;
    make_figure(folder / "figure.gltf", {.fill_light = false});
    EXPECT_EQ(load_scene(folder / "figure.gltf").lights.size(), 1u);
}

TEST(TwoCubes, FlyTowardTheLight) {
    const Folder folder;
    make_two_cubes(folder / "cubes.gltf");
    const Scene scene = load_scene(folder / "cubes.gltf");
    ASSERT_EQ(scene.lights.size(), 1u);
    const auto poses = default_shutter(scene);
    const auto open = posed_positions(scene, poses[0]), close = posed_positions(scene, poses[1]);
    const glm::vec3 to_light = glm::vec3(poses[0].lights[0].rotation * glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_GT(to_light.y, 0.8f);
    for (const char* cube : {"low cube", "high cube"}) {
        EXPECT_EQ(triangles_of(scene, cube).size(), 12u * 22u * 22u);
        expect_closed(scene, cube);
        const uint32_t v = triangles_of(scene, cube)[0].vertex[0];
        EXPECT_LT(glm::length(close[v] - open[v] - 0.8f * to_light), 1e-5f);
    }
}

TEST(RandomCubes, KeepTheirSpeedAndAreClosed) {
    const Folder folder;
    make_random_cubes(folder / "cubes.glb", {.count = 300, .seed = 5, .size = 0.5, .speed_min = 4.0, .speed_max = 8.0});
    const Scene scene = load_scene(folder / "cubes.glb");
    EXPECT_EQ(scene.triangles.size(), 300u * 12u + 2u);
    EXPECT_EQ(scene.skin_count, 1u);
    expect_closed(scene, "cubes");

    const auto poses = default_shutter(scene);
    const auto open = posed_positions(scene, poses[0]), close = posed_positions(scene, poses[1]);
    const auto triangles = triangles_of(scene, "cubes");
    double slowest = 1e9, fastest = 0.0;
    for (std::size_t cube = 0; cube < 300; ++cube) {
        // The mean of its 24 vertices is a cube's center.
        std::set<uint32_t> corners;
        for (std::size_t t = 0; t < 12; ++t) {
            const auto& vertex = triangles[12 * cube + t].vertex;
            corners.insert(std::begin(vertex), std::end(vertex));
        }
        ASSERT_EQ(corners.size(), 24u);
        glm::dvec3 path(0.0);
        for (const uint32_t v : corners) path += glm::dvec3(close[v] - open[v]) / 24.0;
        slowest = std::min(slowest, glm::length(path));
        fastest = std::max(fastest, glm::length(path));
    }
    EXPECT_GT(slowest, 4.0 - 1e-3);
    EXPECT_LT(slowest, 4.2);
    EXPECT_LT(fastest, 8.0 + 1e-3);
    EXPECT_GT(fastest, 7.8);
}

TEST(RandomCubes, DependOnTheSeed) {
    const Folder folder;
    make_random_cubes(folder / "a.glb", {.count = 10, .seed = 1});
    make_random_cubes(folder / "b.glb", {.count = 10, .seed = 2});
    EXPECT_NE(bytes_of_file(folder / "a.glb"), bytes_of_file(folder / "b.glb"));
}

TEST(RandomCubes, FasterOnesFillTheSameSpace) {
    const Folder folder;
    make_random_cubes(folder / "one.glb", {.count = 50});
    make_random_cubes(folder / "four.glb", {.count = 50, .times = 4.0});
    const Scene one = load_scene(folder / "one.glb"), four = load_scene(folder / "four.glb");
    const std::vector<uint32_t> vertices = vertices_of(one, "cubes");
    const double ratio = glm::length(mean(motions(four, {vertices[0]}))) / glm::length(mean(motions(one, {vertices[0]})));
    EXPECT_NEAR(ratio, 4.0, 0.5);  // Cubes turn as they did.
    EXPECT_EQ(default_shutter(one)[0].cameras[0].translation, default_shutter(four)[0].cameras[0].translation);
}

TEST(Pillars, LightMovesInTheFirstShutter) {
    const Folder folder;
    make_pillars(folder / "pillars.gltf", {.columns = 4});
    const Scene scene = load_scene(folder / "pillars.gltf");
    expect_closed(scene, "pillars");
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::spot);
    const auto poses = pose_scene(scene, kFirstAnimation, 0.0, 1.0, 48);
    EXPECT_GT(glm::length(poses[1].lights[0].translation - poses[0].lights[0].translation), 0.2);
    EXPECT_NEAR(poses[48].lights[0].translation.y - poses[0].lights[0].translation.y, 3.0, 1e-5);
    for (const Pose& pose : poses) {  // It always looks at the middle.
        const Rigid& light = pose.lights[0];
        const glm::dvec3 axis = light.rotation * glm::dvec3(0.0, 0.0, -1.0);
        EXPECT_LT(glm::length(axis + glm::normalize(light.translation)), 1e-5);
    }
}

class TubePixels : public testing::TestWithParam<double> {};

TEST_P(TubePixels, MovesAsFarAsAskedFor) {
    const Folder folder;
    make_tube(folder / "tube.glb", {.triangles = 8000, .pixels = GetParam()});
    const Scene scene = load_scene(folder / "tube.glb");
    EXPECT_NEAR(static_cast<double>(scene.triangles.size()), 8000.0, 400.0);
    expect_closed(scene, "tube");

    const auto poses = default_shutter(scene);
    const auto open = posed_positions(scene, poses[0]), close = posed_positions(scene, poses[1]);
    const Rigid camera = poses[0].cameras[0];
    const double scale = 768.0 / 2.0 / std::tan(scene.cameras[0].yfov / 2.0);
    const auto pixel = [&](glm::vec3 p) {
        const glm::dvec3 seen = glm::conjugate(camera.rotation) * (glm::dvec3(p) - camera.translation);
        return glm::dvec2(seen.x, seen.y) / -seen.z * scale;
    };
    double sum = 0.0, count = 0.0;
    for (const Triangle& t : triangles_of(scene, "tube")) {
        sum += glm::length(pixel(close[t.vertex[0]]) - pixel(open[t.vertex[0]]));
        count += 1.0;
    }
    EXPECT_NEAR(sum / count, GetParam(), 0.25 * GetParam() + 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Makers, TubePixels, testing::Values(0.0, 10.0, 40.0));

TEST(Tube, HasTheSizesOfTheBenchmarks) {
    const Folder folder;
    for (const uint32_t triangles : {70000u, 265000u}) {
        make_tube(folder / "tube.glb", {.triangles = triangles});
        EXPECT_NEAR(static_cast<double>(load_scene(folder / "tube.glb").triangles.size()), triangles, 0.05 * triangles);
    }
}

TEST(Stadium, IsASmallBodyOnALargeGround) {
    const Folder folder;
    for (const uint32_t triangles : {30000u, 300000u}) {
        make_stadium(folder / "stadium.glb", {.triangles = triangles, .motion = 0.3});
        const Scene scene = load_scene(folder / "stadium.glb");
        expect_closed(scene, "body");
        EXPECT_NEAR(static_cast<double>(triangles_of(scene, "body").size()), triangles, 0.05 * triangles);
        EXPECT_NEAR(largest(displacements(scene, "body")), 0.3, 1e-6);
        EXPECT_EQ(largest(displacements(scene, "ground")), 0.0);
        const Bounds bounds = bounds_of(scene, default_shutter(scene));
        EXPECT_EQ(bounds.upper.x - bounds.lower.x, 200.0f);
        EXPECT_NEAR(bounds.upper.y - bounds.lower.y, 1.0f, 0.03f);
    }
}

TEST(Makers, GltfAndGlbHoldTheSameScene) {
    const Folder folder;
    make_figure(folder / "a.gltf", {.triangles = 3000});
    make_figure(folder / "b.glb", {.triangles = 3000});
    const Scene a = load_scene(folder / "a.gltf"), b = load_scene(folder / "b.glb");
    EXPECT_EQ(posed_positions(a, default_shutter(a)[1]), posed_positions(b, default_shutter(b)[1]));
}

TEST(Makers, BadOptionsAreErrorsAndLeaveNoFile) {
    const Folder folder;
    const auto kind_of = [](auto&& make) {
        try {
            make();
        } catch (const Error& error) {
            return error.kind();
        }
        return ErrorKind::internal;
    };
    EXPECT_EQ(kind_of([&] { make_figure(folder / "a.gltf", {.triangles = 100}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_two_cubes(folder / "a.gltf", {.triangles = 3}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_random_cubes(folder / "a.gltf", {.count = 0}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_random_cubes(folder / "a.gltf", {.count = 1, .speed_min = 2.0, .speed_max = 1.0}); }),
              ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_random_cubes(folder / "a.gltf", {.count = 1, .size = std::nan("")}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_pillars(folder / "a.gltf", {.columns = 0}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_tube(folder / "a.gltf", {.triangles = 10}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_stadium(folder / "a.gltf", {.triangles = 10}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_character(folder / "a.gltf", {.triangles = 100}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_runner(folder / "a.gltf", {.triangles = 100}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_wrecking_ball(folder / "a.gltf", {.triangles = 100}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_tree(folder / "a.gltf", {.leaves = 0}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_tree(folder / "a.gltf", {.sway = std::nan("")}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_octopus(folder / "a.gltf", {.triangles = 100}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_chess(folder / "a.gltf", {.moving = kChessPieces + 1}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { make_pillars(folder / "a.obj"); }), ErrorKind::usage);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_EQ(kind_of([&] { make_pillars(folder / "missing" / "a.gltf"); }), ErrorKind::input);
}

}  // namespace
}  // namespace gnomon::makers
