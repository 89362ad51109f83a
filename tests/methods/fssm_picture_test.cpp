// SPDX-License-Identifier: Apache-2.0
// Method fssm, what its pictures promise: shadows known in closed form, less noise than tsm, errors where layers are missing,
// the same bits however memory is cut.
#include <gmock/gmock.h>

#include <gnomon/error.hpp>

#include "methods/level_scene.hpp"
#include "support/paths.hpp"
#include "support/two_cubes.hpp"

namespace gnomon::test {
namespace {

/// Shadows fall beside what casts them, where the camera, straight above, sees nothing else: the light is at (-2, 8, 0).
LevelScene shadows_aside(uint32_t segments = 1) {
    const std::vector<glm::dvec3> light(segments + 1, {-2, 8, 0}), camera(segments + 1, {2.4, 9, 0});
    LevelScene scene(light, camera, LightKind::spot, 2.0);
    scene.add({8.0, 8.0}, {{0, 0, 0}});
    return scene;
}

class FssmPictureTest : public testing::Test {
protected:
    static constexpr uint32_t kSide = 48;

    FssmPictureTest() {
        settings.width = settings.height = kSide;
        settings.spp = 16;
        settings.shadow_res = 256;
        settings.method = "fssm";
    }

    std::vector<float> visibility(const PosedScene& scene) {
        return validated_renderer().render(scene.scene, scene.poses, settings).channels.at(5).values;
    }

    static double rmse(const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0.0;
        for (size_t i = 0; i < a.size(); ++i) sum += double(a[i] - b[i]) * double(a[i] - b[i]);
        return std::sqrt(sum / static_cast<double>(a.size()));
    }

    RenderSettings settings;
};

// With two depths a variance shadow map's light is the share of the nearer one's absence, whether both are in one layer or not:
// with share a and distance D, variance a (1 - a) D^2 and the mean a D nearer than the floor, V = 1 - a.
TEST_F(FssmPictureTest, StillShadowIsAVarianceShadow) {
    LevelScene scene = shadows_aside();
    scene.add({0.25, 0.5}, {{0.0, 4.0, 0.1}});
    settings.parameters["bias"] = 1e-3;
    const std::vector<float> four = visibility(scene);
    settings.parameters["layers"] = 1;
    const std::vector<float> one = visibility(scene);
    double sum = 0.0, difference = 0.0;
    for (size_t i = 0; i < one.size(); ++i) {
        sum += four[i];
        difference = std::max(difference, std::abs(double(four[i]) - double(one[i])));
    }
    EXPECT_LT(difference, 0.01);
    // The shadow is twice as large as the square, 1 by 2 of 16 square metres.
    EXPECT_NEAR(sum / static_cast<double>(one.size()), 1.0 - 2.0 / 16.0, 2e-3);
    // Full and no shadow, a texel from its border.
    const auto at = [&](double x, double z) {
        return four[static_cast<size_t>((z + 2.0) / 4.0 * kSide) * kSide + static_cast<size_t>((x - 0.4) / 4.0 * kSide)];
    };
    EXPECT_LT(at(2.0, 0.2), 1e-3f);
    EXPECT_GT(at(2.0, 1.4), 0.999f);
    EXPECT_GT(at(3.0, 0.2), 0.999f);
}

// A square of half width 0.5 goes from z = -1 to 1 at half the light's height. The floor at (x, z) is in its shadow while it is
// within 0.5 of z / 2, where x is between 1.5 and 2.5.
TEST_F(FssmPictureTest, MovingOccluderCoversTheFloorForItsTime) {
    LevelScene scene = shadows_aside();
    scene.add({0.25, 0.5}, {{0.0, 4.0, -1.0}, {0.0, 4.0, 1.0}});
    const std::vector<float> found = visibility(scene);
    double expected_sum = 0.0, sum = 0.0, error = 0.0;
    uint32_t compared = 0;
    for (uint32_t i = 0; i < found.size(); ++i) {
        const double x = 0.4 + 4.0 * (i % kSide + 0.5) / kSide, z = -2.0 + 4.0 * (i / kSide + 0.5) / kSide;
        const double time = std::max(0.0, std::min(z / 2 + 0.5, 1.0) - std::max(z / 2 - 0.5, -1.0)) / 2.0;
        const double expected = x > 1.5 && x < 2.5 ? 1.0 - time : 1.0;
        expected_sum += expected;
        sum += double(found[i]);
        if (std::min(std::abs(x - 1.5), std::abs(x - 2.5)) < 0.15) continue;
        error += std::abs(double(found[i]) - expected);
        ++compared;
    }
    EXPECT_NEAR(sum / (kSide * kSide), expected_sum / (kSide * kSide), 3e-3);
    EXPECT_LT(error / compared, 0.015);
}

// Three squares in three directions at three heights, as in Fig. 9 (A).
TEST_F(FssmPictureTest, FewerLayersThanDepthsAreWrong) {
    LevelScene scene = shadows_aside();
    scene.add({0.2, 0.2}, {{-0.6, 4.4, -0.5}, {0.5, 4.4, 0.4}});
    scene.add({0.3, 0.3}, {{0.9, 2.4, -1.3}, {1.3, 2.4, 1.4}});
    scene.add({0.4, 0.4}, {{1.9, 0.8, 1.6}, {1.5, 0.8, -1.6}});
    settings.method = "exact";
    settings.spp = 64;
    const std::vector<float> exact = visibility(scene);
    settings.method = "fssm";
    std::vector<double> errors;
    for (const double layers : {4.0, 3.0, 2.0, 1.0}) {
        settings.parameters["layers"] = layers;
        errors.push_back(rmse(visibility(scene), exact));
        RecordProperty("rmse_" + std::to_string(static_cast<int>(layers)), std::to_string(errors.back()));
    }
    EXPECT_LT(errors[0], 0.06);
    for (size_t i = 1; i < errors.size(); ++i) EXPECT_GT(errors[i], 1.05 * errors[i - 1]) << i;
}

// Of the shipped scenes, over seeds, at as many samples and texels.
TEST_F(FssmPictureTest, HasLessNoiseThanTimeDependentShadowMaps) {
    constexpr uint32_t kSeeds = 6;
    settings.width = 96;
    settings.height = 54;
    settings.spp = 4;
    for (const char* name : {"two-cubes", "pillars", "figure"}) {
        const Scene scene =
            load_scene(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes" / (std::string(name) + ".gltf"));
        const std::vector<Pose> poses = pose_scene(scene, {AnimationChoice::Kind::all, 0}, 0.0, 1.0 / 48.0, 2);
        std::map<std::string, double> variance;
        for (const char* method : {"tsm", "fssm"}) {
            settings.method = method;
            std::vector<double> sums(size_t(settings.width) * settings.height), squares(sums.size());
            for (settings.seed = 0; settings.seed < kSeeds; ++settings.seed) {
                const Frame frame = validated_renderer().render(scene, poses, settings);
                for (size_t i = 0; i < sums.size(); ++i) {
                    const double v = frame.channels.at(5).values[i];
                    sums[i] += v;
                    squares[i] += v * v;
                }
            }
            for (size_t i = 0; i < sums.size(); ++i)
                variance[method] += (squares[i] - sums[i] * sums[i] / kSeeds) / (kSeeds - 1) / static_cast<double>(sums.size());
        }
        RecordProperty(std::string(name) + "_tsm", std::to_string(variance["tsm"]));
        RecordProperty(std::string(name) + "_fssm", std::to_string(variance["fssm"]));
        EXPECT_LT(variance["fssm"], 0.8 * variance["tsm"]) << name;
    }
}

class FssmCubesTest : public TwoCubes<> {
protected:
    FssmCubesTest() : TwoCubes(96, 64, 4) {
        settings.method = "fssm";
        settings.shadow_res = 250;
    }
};

TEST_F(FssmCubesTest, MemoryAndBatchesDoNotMatter) {
    for (const double tile : {8.0, 4.0}) {
        settings.parameters["tile"] = tile;
        settings.memory_budget = 0;
        const Frame expected = validated_renderer().render(scene, poses, settings);
        // A tile's grid and mip levels, 16 bytes a tuple, and the layer itself.
        const uint64_t tiles = tile == 8.0 ? 32 * 32 : 63 * 63, tuples = tile == 8.0 ? 341 : 85;
        EXPECT_EQ(expected.stats.counts.at("layer_bytes.0"), tiles * (tuples * 16 + 16));
        EXPECT_EQ(expected.stats.buffer_bytes.at("fssm.tuples") + expected.stats.buffer_bytes.at("fssm.layers"),
                  4 * tiles * (tuples * 16 + 16));
        expect_same_bits(validated_renderer().render(scene, poses, settings), expected);
        settings.memory_budget = 16u << 20;
        const Frame frame = validated_renderer().render(scene, poses, settings);
        EXPECT_LT(frame.stats.buffer_bytes.at("fssm.tuples"), expected.stats.buffer_bytes.at("fssm.tuples")) << "no bands";
        EXPECT_LT(frame.stats.buffer_bytes.at("map_samples"), expected.stats.buffer_bytes.at("map_samples")) << "no parts";
        EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
        expect_same_bits(frame, expected);
    }
}

TEST_F(FssmCubesTest, TooLittleMemoryIsSaid) {
    settings.shadow_res = 4096;
    settings.memory_budget = 32u << 20;
    try {
        validated_renderer().render(scene, poses, settings);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::out_of_memory);
        EXPECT_THAT(error.what(), testing::HasSubstr("one row of a light's map"));
    }
}

}  // namespace
}  // namespace gnomon::test
