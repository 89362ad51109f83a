// SPDX-License-Identifier: Apache-2.0
// The scenes after those of papers: as large as there, closed, and what is said to move does so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "folder.hpp"
#include "scene_checks.hpp"

namespace gnomon::makers {
namespace {

double triangle_count(const Scene& scene) { return static_cast<double>(scene.triangles.size()); }

glm::dvec3 axis_of(const Rigid& light) { return light.rotation * glm::dvec3(0.0, 0.0, -1.0); }

/// The first light always looks at one point.
void expect_aimed(const std::vector<Pose>& poses, const glm::dvec3& target) {
    for (const Pose& pose : poses) {
        const Rigid& light = pose.lights[0];
        EXPECT_LT(glm::length(axis_of(light) - glm::normalize(target - light.translation)), 1e-5);
    }
}

template <class Make, class Options>
Scene made(const Folder& folder, const Make& make, const Options& options) {
    make(folder / "scene.glb", options);
    Scene scene = load_scene(folder / "scene.glb");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    return scene;
}

class CharacterSizes : public testing::TestWithParam<uint32_t> {};

TEST_P(CharacterSizes, AreThoseOfThePapersAndClosed) {
    const Folder folder;
    const Scene scene = made(folder, make_character, CharacterOptions{.triangles = GetParam()});
    EXPECT_NEAR(static_cast<double>(triangles_of(scene, "character").size()), GetParam(), 0.03 * GetParam());
    EXPECT_EQ(scene.lights.size(), 1u);
    expect_closed(scene, "character");
}

INSTANTIATE_TEST_SUITE_P(Makers, CharacterSizes, testing::Values(2000u, 70000u, 265000u));

TEST(Character, KicksTowardTheLightAndStandsOnTheOtherFoot) {
    const Folder folder;
    const Scene scene = made(folder, make_character, CharacterOptions{.triangles = 12000});
    std::vector<uint32_t> left, right;  // By the bind pose.
    for (const uint32_t v : vertices_of(scene, "character")) {
        const glm::vec3 p = scene.vertices[v].position;
        if (p.y < 0.05f) (p.z > 0.0f ? right : left).push_back(v);
    }
    const auto poses = default_shutter(scene);
    const glm::dvec3 foot(posed_positions(scene, poses[0])[right[0]]);
    const glm::dvec3 to_light = glm::normalize(poses[0].lights[0].translation - foot);
    EXPECT_GT(glm::dot(mean(motions(scene, right)), to_light), 0.35);
    EXPECT_LT(glm::length(mean(motions(scene, left))), 1e-3);

    for (const Pose& pose : pose_scene(scene, kFirstAnimation, 0.0, 1.0, 203)) {
        const auto positions = posed_positions(scene, pose);
        float lowest = 1.0f;
        for (const uint32_t v : vertices_of(scene, "character")) lowest = std::min(lowest, positions[v].y);
        ASSERT_NEAR(lowest, 0.0f, 1e-3f) << "at " << pose.seconds << " s";
    }
}

TEST(Runner, IsAsLargeAsAskedForAndClosed) {
    const Folder folder;
    for (const uint32_t triangles : {20000u, 262000u}) {
        const Scene scene = made(folder, make_runner, RunnerOptions{.triangles = triangles});
        EXPECT_NEAR(triangle_count(scene), triangles, 0.1 * triangles);
        for (const char* material : {"runner", "columns", "walls"}) expect_closed(scene, material);
    }
}

TEST(Runner, StepsOnTheGroundAndFliesBetweenTheSteps) {
    const Folder folder;
    const Scene scene = made(folder, make_runner, RunnerOptions{.triangles = 20000});
    const std::vector<uint32_t> body = vertices_of(scene, "runner");
    int on_ground = 0, in_flight = 0;
    for (const Pose& pose : pose_scene(scene, kFirstAnimation, 0.0, 0.5, 301)) {
        const auto positions = posed_positions(scene, pose);
        float lowest = 1.0f;
        for (const uint32_t v : body) lowest = std::min(lowest, positions[v].y);
        ASSERT_GT(lowest, -2e-3f) << "at " << pose.seconds << " s";
        ASSERT_LT(lowest, 0.06f) << "at " << pose.seconds << " s";
        (lowest < 2e-3f ? on_ground : in_flight) += 1;
    }
    EXPECT_NEAR(in_flight, 0.4 * 302, 12);
    EXPECT_GT(on_ground, 150);
    // A leg that comes forward moves twice as fast as the body.
    EXPECT_NEAR(mean(motions(scene, body)).x, 6.2 * kShutterSeconds, 0.03);
    EXPECT_GT(largest(displacements(scene, "runner")), 1.8 * 6.2 * kShutterSeconds);
    EXPECT_EQ(largest(displacements(scene, "columns")), 0.0);
}

TEST(WreckingBall, HasTheSizeOfThePaperAndIsClosed) {
    const Folder folder;
    for (const uint32_t triangles : {8000u, 100000u}) {
        const Scene scene = made(folder, make_wrecking_ball, WreckingBallOptions{.triangles = triangles});
        EXPECT_NEAR(triangle_count(scene), triangles, 0.1 * triangles);
        for (const char* material : {"doll", "chain", "ball"}) expect_closed(scene, material);
    }
}

TEST(WreckingBall, SwingsAtTheDoll) {
    const Folder folder;
    const Scene scene = made(folder, make_wrecking_ball, WreckingBallOptions{});
    const auto positions = posed_positions(scene, default_shutter(scene)[0]);
    const auto centre = [&](const std::string& material) {
        std::vector<glm::dvec3> places;
        for (const uint32_t v : vertices_of(scene, material)) places.emplace_back(positions[v]);
        return mean(places);
    };
    glm::dvec3 to_doll = centre("doll") - centre("ball");
    to_doll.y = 0.0;
    const glm::dvec3 swing = mean(motions(scene, vertices_of(scene, "ball")));
    EXPECT_GT(glm::dot(swing, glm::normalize(to_doll)), 0.25);
    EXPECT_LT(glm::length(swing), 0.45);
    EXPECT_GT(largest(displacements(scene, "doll")), 0.2);
    // The chain hangs on a fixed point.
    const auto chain = displacements(scene, "chain");
    EXPECT_LT(*std::min_element(chain.begin(), chain.end()), 0.02);
}

TEST(Tree, HasTheLeavesAskedForAndClosedBranches) {
    const Folder folder;
    const Scene scene = made(folder, make_tree, TreeOptions{.leaves = 3001});
    EXPECT_EQ(triangles_of(scene, "leaves").size(), 2u * 3001u);
    expect_closed(scene, "branches");
    const auto positions = posed_positions(scene, default_shutter(scene)[0]);
    for (const uint32_t v : vertices_of(scene, "leaves")) ASSERT_GT(positions[v].y, 0.5f);
}

TEST(Tree, OnlyTheLightMovesUnlessItSways) {
    const Folder folder;
    const Scene still = made(folder, make_tree, TreeOptions{.leaves = 500});
    EXPECT_EQ(still.skin_count, 0u);
    EXPECT_EQ(largest(displacements(still, "leaves")), 0.0);
    const auto poses = pose_scene(still, kFirstAnimation, 0.0, 1.0, 48);
    EXPECT_NEAR(glm::length(poses[1].lights[0].translation - poses[0].lights[0].translation), 0.9, 0.02);
    // It does not turn: linear motion of its view is then exact.
    for (const Pose& pose : poses) EXPECT_EQ(pose.lights[0].rotation, poses[0].lights[0].rotation);

    const Scene sways = made(folder, make_tree, TreeOptions{.leaves = 500, .sway = 0.05});
    EXPECT_GT(largest(displacements(sways, "leaves")), 0.02);
    EXPECT_LT(largest(displacements(sways, "leaves")), 0.2);
    // The same tree: only its limbs turn.
    const uint32_t v = vertices_of(sways, "leaves")[0];
    EXPECT_EQ(still.vertices[vertices_of(still, "leaves")[0]].position, sways.vertices[v].position);
}

TEST(Chess, IsAsLargeAsAskedForAndClosed) {
    const Folder folder;
    for (const uint32_t triangles : {10000u, 160000u}) {
        const Scene scene = made(folder, make_chess, ChessOptions{.triangles = triangles});
        EXPECT_NEAR(triangle_count(scene), triangles, 0.1 * triangles);
        for (const char* material : {"white", "black", "board"}) expect_closed(scene, material);
    }
}

TEST(Chess, AsManyPiecesFlyAsAskedFor) {
    const Folder folder;
    for (const uint32_t moving : {1u, 9u, kChessPieces}) {
        const Scene scene = made(folder, make_chess, ChessOptions{.triangles = 10000, .moving = moving});
        std::set<uint32_t> pieces, flying;
        for (const char* color : {"white", "black"}) {
            const std::vector<uint32_t> vertices = vertices_of(scene, color);
            const std::vector<glm::dvec3> moved = motions(scene, vertices);
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                const uint32_t piece = scene.influences[scene.vertices[vertices[i]].influence_first].matrix;
                pieces.insert(piece);
                if (glm::length(moved[i]) > 0.0) flying.insert(piece);
                EXPECT_LT(glm::length(moved[i]), 1.6);
            }
        }
        EXPECT_EQ(pieces.size(), kChessPieces);
        EXPECT_EQ(flying.size(), moving);
    }
}

TEST(Octopus, IsAsLargeAsAskedForAndClosed) {
    const Folder folder;
    for (const uint32_t triangles : {50000u, 200000u}) {
        const Scene scene = made(folder, make_octopus, OctopusOptions{.triangles = triangles});
        EXPECT_NEAR(triangle_count(scene), triangles, 0.1 * triangles);
        for (const char* material : {"head", "arms"}) expect_closed(scene, material);
    }
}

TEST(Octopus, ArmsMoveFastInDifferentDirectionsOverTheGround) {
    const Folder folder;
    const Scene scene = made(folder, make_octopus, OctopusOptions{.triangles = 50000});
    EXPECT_EQ(scene.skin_count, 8u);
    for (const Pose& pose : pose_scene(scene, kFirstAnimation, 0.0, 1.0, 97)) {
        const auto positions = posed_positions(scene, pose);
        for (const uint32_t v : vertices_of(scene, "arms")) ASSERT_GT(positions[v].y, 0.0f) << "at " << pose.seconds << " s";
    }
    // The tip of each arm is at 1.9 m in its own space.
    std::vector<uint32_t> tips;
    for (const uint32_t v : vertices_of(scene, "arms")) {
        if (scene.vertices[v].position.x > 1.8999f) tips.push_back(v);
    }
    ASSERT_EQ(tips.size(), 8u);
    double sum = 0.0;
    const auto moved = motions(scene, tips);
    for (const glm::dvec3& motion : moved) sum += glm::length(motion) / 8.0;
    EXPECT_GT(sum, 0.1);
    EXPECT_LT(glm::length(mean(moved)), 0.6 * sum);
}

TEST(PaperScenes, DependOnTheSeed) {
    const Folder folder;
    make_tree(folder / "a.glb", {.leaves = 200, .seed = 1});
    make_tree(folder / "b.glb", {.leaves = 200, .seed = 2});
    EXPECT_NE(bytes_of_file(folder / "a.glb"), bytes_of_file(folder / "b.glb"));
    make_octopus(folder / "a.glb", {.triangles = 50000, .seed = 1});
    make_octopus(folder / "b.glb", {.triangles = 50000, .seed = 2});
    EXPECT_NE(bytes_of_file(folder / "a.glb"), bytes_of_file(folder / "b.glb"));
    make_chess(folder / "a.glb", {.triangles = 10000, .seed = 1});
    make_chess(folder / "b.glb", {.triangles = 10000, .seed = 2});
    EXPECT_NE(bytes_of_file(folder / "a.glb"), bytes_of_file(folder / "b.glb"));
}

TEST(PaperScenes, FillLightCanBeAdded) {
    const Folder folder;
    EXPECT_EQ(made(folder, make_character, CharacterOptions{.triangles = 2000, .fill_light = true}).lights.size(), 2u);
    EXPECT_EQ(made(folder, make_wrecking_ball, WreckingBallOptions{.fill_light = true}).lights.size(), 2u);
    EXPECT_EQ(made(folder, make_tree, TreeOptions{.leaves = 100, .fill_light = true}).lights.size(), 2u);
    EXPECT_EQ(made(folder, make_chess, ChessOptions{.triangles = 10000, .fill_light = true}).lights.size(), 2u);
    EXPECT_EQ(made(folder, make_octopus, OctopusOptions{.triangles = 50000, .fill_light = true}).lights.size(), 2u);
    EXPECT_EQ(made(folder, make_runner, RunnerOptions{.triangles = 20000, .fill_light = true}).lights.size(), 2u);
}

TEST(PaperScenes, CubesHaveThePapersNumbers) {
    const Folder folder;
    make_two_cubes(folder / "two.glb");
    EXPECT_NEAR(triangle_count(load_scene(folder / "two.glb")), 12000.0, 0.05 * 12000.0);
    for (const uint32_t count : {4000u, 5000u}) {
        make_random_cubes(folder / "cubes.glb", {.count = count});
        EXPECT_EQ(load_scene(folder / "cubes.glb").triangles.size(), 12u * count + 2u);
    }
}

TEST(Pillars, LightRisesAndGoesAway) {
    const Folder folder;
    make_pillars(folder / "pillars.glb", {.rising = true});
    const Scene scene = load_scene(folder / "pillars.glb");
    const auto poses = pose_scene(scene, kFirstAnimation, 0.0, 1.0, 48);
    expect_aimed(poses, glm::dvec3(0.0));
    const glm::dvec3 from = poses[0].lights[0].translation, to = poses[1].lights[0].translation;
    EXPECT_NEAR(glm::length(to) / glm::length(from), 4.0 / 3.0, 1e-5);
    EXPECT_GT(to.y - from.y, 1.0);
}

}  // namespace
}  // namespace gnomon::makers
