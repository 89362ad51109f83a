// SPDX-License-Identifier: Apache-2.0
// Animations: interpolation by hand-worked numbers, clamping, choices.
#include <limits>

#include "gltf_builder.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

// A triangle whose node is animated by one channel.
template <typename T = float>
void animate(Gltf& gltf, const std::string& path, const std::string& interpolation, const std::vector<float>& times,
             const std::string& type, const std::vector<T>& values, bool normalized = false) {
    const int input = gltf.accessor<float>("SCALAR", times);
    const int output = gltf.accessor<T>(type, values, normalized);
    gltf.add("animations", {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
}

Scene translated(const std::string& interpolation, const std::vector<float>& values) {
    Gltf gltf;
    gltf.add_triangle();
    animate(gltf, "translation", interpolation, {1, 3}, "VEC3", values);
    return gltf.load();
}

float x_at(const Scene& scene, double seconds) { return positions_at(scene, seconds)[0].x; }

TEST(Animation, LinearAndClamped) {
    const Scene scene = translated("LINEAR", {10, 0, 0, 20, 0, 0});
    EXPECT_EQ(x_at(scene, 0), 10.0f);
    EXPECT_EQ(x_at(scene, 1), 10.0f);
    EXPECT_EQ(x_at(scene, 1.5), 12.5f);
    EXPECT_EQ(x_at(scene, 3), 20.0f);
    EXPECT_EQ(x_at(scene, 9), 20.0f);
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].start, 1.0);
    EXPECT_EQ(scene.animations[0].end, 3.0);
    EXPECT_EQ(scene.animations[0].channels, 1u);
}

TEST(Animation, StepHoldsUntilTheNextKey) {
    const Scene scene = translated("STEP", {10, 0, 0, 20, 0, 0});
    EXPECT_EQ(x_at(scene, 0), 10.0f);
    EXPECT_EQ(x_at(scene, 2.999), 10.0f);
    EXPECT_EQ(x_at(scene, 3), 20.0f);
}

TEST(Animation, CubicSplineScalesTangentsByTheInterval) {
    // In-tangent, value, out-tangent for either key; the interval is 2 s.
    const Scene scene = translated("CUBICSPLINE", {9, 0, 0, 10, 0, 0, 3, 0, 0, -5, 0, 0, 20, 0, 0, 9, 0, 0});
    EXPECT_EQ(x_at(scene, 0), 10.0f);
    EXPECT_EQ(x_at(scene, 5), 20.0f);
    // At half: 0.5 * 10 + 2 * 0.125 * 3 + 0.5 * 20 + 2 * (-0.125) * (-5) = 17.
    EXPECT_FLOAT_EQ(x_at(scene, 2), 17.0f);
    // At a quarter: 0.84375 * 10 + 2 * 0.140625 * 3 + 0.15625 * 20 + 2 * (-0.046875) * (-5) = 12.875.
    EXPECT_FLOAT_EQ(x_at(scene, 1.5), 12.875f);
}

TEST(Animation, RotationsTurnTheShorterWay) {
    Gltf gltf;
    gltf.add_triangle();
    // From 0 to 90 degrees about Z, the second quaternion negated: a third of the way is 30 degrees.
    const float h = std::sqrt(0.5f);
    animate(gltf, "rotation", "LINEAR", {0, 3}, "VEC4", {0, 0, 0, 1, 0, 0, -h, -h});
    EXPECT_THAT(positions_at(gltf.load(), 1)[1], near_to({std::sqrt(0.75f), 0.5f, 0}));
}

TEST(Animation, RotationsFromNormalizedIntegers) {
    Gltf gltf;
    gltf.add_triangle();
    animate<int16_t>(gltf, "rotation", "STEP", {0}, "VEC4", {0, 0, 23170, 23170}, true);
    EXPECT_THAT(positions_at(gltf.load(), 0)[1], near_to({0, 1, 0}));
}

TEST(Animation, CubicRotationsAreNormalized) {
    Gltf gltf;
    gltf.add_triangle();
    const float h = std::sqrt(0.5f);
    animate(gltf, "rotation", "CUBICSPLINE", {0, 1}, "VEC4",
            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0});
    EXPECT_THAT(positions_at(gltf.load(), 0.5)[1], near_to({h, h, 0}));
}

TEST(Animation, ScaleKeepsTheRest) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0]["translation"] = {5, 0, 0};
    animate(gltf, "scale", "LINEAR", {0, 1}, "VEC3", {1, 1, 1, 3, 3, 3});
    EXPECT_THAT(positions_at(gltf.load(), 0.5)[1], near_to({7, 0, 0}));
}

TEST(Animation, StridedSamplers) {
    Gltf gltf;
    gltf.add_triangle();
    const int view = gltf.view<float>({0, 10, 0, 0, 1, 20, 0, 0});
    gltf.doc["bufferViews"][static_cast<size_t>(view)]["byteStride"] = 16;
    const int input = gltf.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", 2}});
    const int output = gltf.add(
        "accessors", {{"bufferView", view}, {"byteOffset", 4}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 2}});
    gltf.add("animations", {{"samplers", {{{"input", input}, {"output", output}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    EXPECT_EQ(x_at(gltf.load(), 0.5), 15.0f);
}

void add_morph(Gltf& gltf) {
    const json target = {{"POSITION", gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})}};
    gltf.doc["meshes"][0]["primitives"][0]["targets"] = {target, target};
}

TEST(Animation, MorphWeights) {
    Gltf gltf;
    gltf.add_triangle();
    add_morph(gltf);
    animate<uint8_t>(gltf, "weights", "LINEAR", {0, 1}, "SCALAR", {0, 51, 255, 255}, true);
    const Scene scene = gltf.load();
    EXPECT_THAT(pose_at(scene, 0).morph_weights, testing::ElementsAre(0.0f, testing::FloatEq(0.2f)));
    // At a half 0.5 and 0.6, both targets one up.
    EXPECT_THAT(positions_at(scene, 0.5)[0], near_to({0, 0, 1.1f}));
}

TEST(Animation, CubicMorphWeightsComeInThreeGroups) {
    Gltf gltf;
    gltf.add_triangle();
    add_morph(gltf);
    // Per key: two in-tangents, two values, two out-tangents.
    animate(gltf, "weights", "CUBICSPLINE", {0, 1}, "SCALAR", {0, 0, 1, 2, 0, 0, 0, 0, 3, 6, 0, 0});
    EXPECT_THAT(pose_at(gltf.load(), 0.5).morph_weights, testing::ElementsAre(2.0f, 4.0f));
}

TEST(Animation, CountsMustFit) {
    const auto error_with = [](const std::string& path, const std::string& interpolation, const std::string& type,
                               size_t numbers) {
        Gltf gltf;
        gltf.add_triangle();
        animate(gltf, path, interpolation, {0, 1}, type, std::vector<float>(numbers, 0.5f));
        return gltf.error();
    };
    EXPECT_EQ(error_with("translation", "LINEAR", "VEC3", 6), "");
    EXPECT_THAT(error_with("translation", "LINEAR", "VEC3", 9), HasSubstr("has 3 values, 2 are needed"));
    EXPECT_THAT(error_with("translation", "CUBICSPLINE", "VEC3", 6), HasSubstr("has 2 values, 6 are needed"));
    EXPECT_THAT(error_with("rotation", "LINEAR", "VEC3", 6), HasSubstr("does not fit the path"));
    EXPECT_THAT(error_with("weights", "LINEAR", "SCALAR", 2), HasSubstr("has no morph targets"));
    EXPECT_THAT(error_with("scale", "BEZIER", "VEC3", 6), HasSubstr("unknown interpolation 'BEZIER'"));
}

TEST(Animation, KeysMustAscend) {
    Gltf gltf;
    gltf.add_triangle();
    animate(gltf, "translation", "LINEAR", {0, 2, 1}, "VEC3", std::vector<float>(9, 0.0f));
    EXPECT_THAT(gltf.error(), HasSubstr("do not ascend at key frame 2"));
    Gltf infinite;
    infinite.add_triangle();
    animate(infinite, "translation", "LINEAR", {0, std::numeric_limits<float>::infinity()}, "VEC3",
            std::vector<float>(6, 0.0f));
    EXPECT_THAT(infinite.error(), HasSubstr("not finite"));
}

TEST(Animation, EqualKeysJump) {
    Gltf gltf;
    gltf.add_triangle();
    animate(gltf, "translation", "LINEAR", {0, 1, 1, 2}, "VEC3", {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0});
    const Scene scene = gltf.load();
    EXPECT_EQ(x_at(scene, 0.5), 0.5f);
    EXPECT_EQ(x_at(scene, 1), 5.0f);
}

TEST(Animation, MatricesCannotBeAnimated) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    animate(gltf, "translation", "LINEAR", {0}, "VEC3", {0, 0, 0});
    EXPECT_THAT(gltf.error(), HasSubstr("has a matrix"));
}

TEST(Animation, ChannelsThatCannotBeFollowedAreCounted) {
    Gltf gltf;
    gltf.add_triangle();
    animate(gltf, "translation", "LINEAR", {0}, "VEC3", {7, 0, 0});
    json& channels = gltf.doc["animations"][0]["channels"];
    channels.push_back({{"sampler", 0}, {"target", {{"path", "scale"}}}});
    channels.push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "pointer"}}}});
    channels.push_back(channels[0]);
    const Scene scene = gltf.load();
    EXPECT_EQ(x_at(scene, 0), 7.0f);
    EXPECT_THAT(scene.warnings, has_warning("animation 0: 3 channels"));
}

TEST(Animation, ResultsThatAreNotFiniteAreErrorsWhenPosed) {
    Gltf gltf;
    gltf.add_triangle();
    gltf.doc["nodes"][0]["name"] = "Wing";
    animate(gltf, "translation", "LINEAR", {0, 1}, "VEC3", {0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0});
    gltf.doc["animations"][0]["name"] = "Flap";
    const Scene scene = gltf.load();
    EXPECT_NO_THROW(pose_at(scene, 0.5, {AnimationChoice::Kind::none, 0}));
    try {
        pose_at(scene, 0.5);
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::input);
        EXPECT_THAT(e.what(), HasSubstr("node 0 'Wing'"));
        EXPECT_THAT(e.what(), HasSubstr("animation 0 'Flap'"));
    }
}

Scene with_three_animations() {
    Gltf gltf;
    gltf.add_triangle();
    animate(gltf, "translation", "STEP", {0}, "VEC3", {1, 0, 0});
    animate(gltf, "scale", "STEP", {0}, "VEC3", {2, 2, 2});
    animate(gltf, "translation", "STEP", {0}, "VEC3", {3, 0, 0});
    gltf.doc["animations"][0]["name"] = "Walk";
    gltf.doc["animations"][1]["name"] = "Run";
    gltf.doc["animations"][2]["name"] = "Run";
    return gltf.load();
}

TEST(Animation, Choices) {
    const Scene scene = with_three_animations();
    const auto second_x = [&](const std::string& option) {
        return posed_positions(scene, pose_at(scene, 0, choose_animation(scene, option)))[1].x;
    };
    EXPECT_EQ(second_x(""), 2.0f);  // (1, 0, 0) + 1
    EXPECT_EQ(second_x("Walk"), 2.0f);
    EXPECT_EQ(second_x("1"), 2.0f);  // Twice as large.
    EXPECT_EQ(second_x("2"), 4.0f);
    EXPECT_EQ(second_x("none"), 1.0f);
    EXPECT_EQ(second_x("all"), 5.0f);  // Twice as large and, the last of both, 3 to the right.
}

TEST(Animation, ChoicesThatAreNoneNameWhatThereIs) {
    const Scene scene = with_three_animations();
    for (const char* option : {"Run", "Jump", "3", "-1", "1x"}) {
        try {
            choose_animation(scene, option);
            FAIL() << option;
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::usage);
            EXPECT_THAT(e.what(), HasSubstr("0 'Walk', 1 'Run', 2 'Run'"));
        }
    }
    Gltf still;
    const Scene empty = still.load();
    EXPECT_NO_THROW(choose_animation(empty, "0"));
    EXPECT_THROW(choose_animation(empty, "1"), Error);
    EXPECT_THROW(pose_at(scene, 0, {AnimationChoice::Kind::one, 3}), Error);
}

TEST(Animation, PosesAreEquallySpaced) {
    const Scene scene = translated("LINEAR", {0, 0, 0, 2, 0, 0});
    const std::vector<Pose> poses = pose_scene(scene, {}, 1.0, 2.0, 4);
    ASSERT_EQ(poses.size(), 5u);
    for (size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(poses[k].seconds, 1.0 + 0.25 * static_cast<double>(k));
        EXPECT_EQ(posed_positions(scene, poses[k])[0].x, 0.25f * static_cast<float>(k));
    }
}

}  // namespace
}  // namespace gnomon::test
