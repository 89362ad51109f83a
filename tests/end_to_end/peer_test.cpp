// SPDX-License-Identifier: Apache-2.0
// The benchmark's peer makes the reference's picture. It computes in float: single samples may differ at edges and where
// shadows begin, pictures as a whole may not.
#include "peer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/scene_makers.hpp"
#include "shapes.hpp"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kWidth = 230, kHeight = 170;  // No multiples of a tile.

PeerSettings peer_settings(uint32_t spp) {
    PeerSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.spp = spp;
    settings.seed = 5;
    settings.threads = 2;
    return settings;
}

Frame reference_frame(const PosedScene& posed, uint32_t spp) {
    RenderSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.spp = spp;
    settings.seed = 5;
    return reference_frame(posed, settings);
}

double mean(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += std::abs(double{a[i]} - b[i]);
    return sum / static_cast<double>(a.size());
}

// Means, and what pixels differ by on average, relative to the mean; of visibility_var relative to 1. Visibility differs most:
// on faces that are turned from the light the peer's tolerance misses what shadows the rim, and no R G B shows it.
void expect_same_picture(const Frame& frame, const Frame& truth) {
    ASSERT_EQ(frame.channels.size(), truth.channels.size());
    for (size_t i = 0; i < truth.channels.size(); ++i) {
        const Channel &got = frame.channels[i], &expected = truth.channels[i];
        ASSERT_EQ(got.name, expected.name);
        const double whole = mean(expected.values), unit = got.name.starts_with("visibility_var") ? 1.0 : whole;
        ASSERT_GT(whole, 0.0) << got.name;
        const double tolerance = (got.name == "visibility.0" ? 8e-4 : 2e-4) * unit;
        EXPECT_LE(std::abs(mean(got.values) - whole), tolerance) << got.name;
        EXPECT_LE(mean_difference(got.values, expected.values), 2.0 * tolerance) << got.name;
    }
    EXPECT_EQ(frame.stats.counts.at("samples"), truth.stats.counts.at("samples"));
}

struct SceneCase {
    std::string name;
    std::function<void(const fs::path&)> make;
    LoadOptions options;
};

void PrintTo(const SceneCase& c, std::ostream* out) { *out << c.name; }

class PeerOfScene : public testing::TestWithParam<SceneCase> {};

TEST_P(PeerOfScene, MakesTheReferencesPicture) {
    const PosedScene posed = load_posed(made_file(GetParam().name, GetParam().make), GetParam().options);
    const Frame truth = reference_frame(posed, 8);
    for (const PeerBuild& build : {PeerBuild{1, PeerQuality::medium}, PeerBuild{8, PeerQuality::high}}) {
        SCOPED_TRACE(name_of(build));
        expect_same_picture(trace_peer(posed.scene, posed.poses, peer_settings(8), build, {}), truth);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, PeerOfScene,
    testing::Values(SceneCase{"two_cubes", [](const fs::path& p) { makers::make_two_cubes(p, {6000}); }, {}},
                    SceneCase{"random_cubes", [](const fs::path& p) { makers::make_random_cubes(p); }, {}},
                    SceneCase{"figure", [](const fs::path& p) { makers::make_figure(p); }, {"0", 3}},
                    SceneCase{"pillars", [](const fs::path& p) { makers::make_pillars(p); }, {"0", 2}},
                    SceneCase{"tube", [](const fs::path& p) { makers::make_tube(p); }, {}}),
    [](const auto& tested) { return tested.param.name; });

// A camera that turns and flies, a turning sun, a wandering spot and a point light of limited range.
MovingTriangles everything_moves(const Camera& camera) {
    MovingTriangles scene(2);
    add_floor(scene, 0.0f, 4.0f);
    add_box(scene, {-0.6f, 0.7f, 0.0f}, {0.4f, 0.4f, 0.4f}, {0.5f, 0.3f, 0.2f});
    add_sphere(scene, {0.7f, 0.8f, 0.3f}, 0.5f, 9, {-0.4f, 0.2f, 0.0f});
    scene.add(camera, {at({0.0, 3.0, 4.0}, {0.0, 0.5, 0.0}), at({0.3, 3.1, 3.9}, {0.1, 0.4, 0.1}),
                       at({0.9, 3.0, 3.6}, {0.0, 0.5, 0.0})});
    scene.add(sun(2.0f), {at({1.0, 3.0, 1.0}, {}), at({1.4, 3.0, 1.0}, {}), at({1.5, 3.0, 0.6}, {})});
    Light lamp = spot(0.6f, 0.4f, 20.0f);
    lamp.range = 6.0f;
    scene.add(lamp, {at({-1.5, 3.0, 1.5}, {}), at({-1.2, 3.2, 1.5}, {0.2, 0.0, 0.0}), at({-1.0, 3.0, 1.0}, {0.3, 0.0, 0.0})});
    lamp.kind = LightKind::point;
    scene.add(lamp, {at({0.1, 1.6, 0.9}, {}), at({0.3, 1.5, 0.8}, {}), at({0.2, 1.7, 1.0}, {})});
    return scene;
}

TEST(Peer, FollowsMovingCamerasAndLights) {
    for (const Camera& camera : {perspective(0.7), orthographic(1.6)}) {
        const MovingTriangles scene = everything_moves(camera);
        const Frame truth = reference_frame(scene, 8);
        expect_same_picture(trace_peer(scene.scene, scene.poses, peer_settings(8), {}, {}), truth);
    }
}

TEST(Peer, EveryWayToTraceMakesOnePicture) {
    const MovingTriangles scene = everything_moves(perspective(0.7));
    for (const uint32_t spp : {1u, 5u, 300u}) {  // No multiple of a packet, and more than a batch.
        PeerSettings settings = peer_settings(spp);
        if (spp == 300) settings.width = settings.height = 20;
        const Frame first = trace_peer(scene.scene, scene.poses, settings, {}, {});
        const PeerScene loaded(scene.scene, settings.threads);
        Frame frame;
        for (const PeerBuild& build : peer_builds()) {
            const Peer peer(loaded, scene.poses, settings, build);
            for (const PeerRays& rays : peer_rays()) {
                SCOPED_TRACE(name_of(build) + ", " + name_of(rays));
                for (Channel& known : frame.channels) std::ranges::fill(known.values, 7.0f);  // Its memory is all that is used.
                peer.trace(rays, frame);
                for (size_t i = 0; i < first.channels.size(); ++i) {
                    const double whole = mean(first.channels[i].values);
                    EXPECT_LE(mean_difference(frame.channels[i].values, first.channels[i].values), 1e-4 * whole)
                        << first.channels[i].name;
                }
            }
        }
    }
}

}  // namespace
}  // namespace gnomon::test
