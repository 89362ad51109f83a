// SPDX-License-Identifier: Apache-2.0
// The made files against the rules of glTF 2.0 that loaders seldom check: ranges, alignment, bounds, key times, texts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <scenes/scene_makers.hpp>
#include <set>
#include <string>
#include <vector>

#include "folder.hpp"

namespace gnomon::makers {
namespace {

using Json = nlohmann::json;

constexpr const char* kKeptScenes[] = {"figure", "two-cubes",      "random-cubes",  "pillars",
                                       "tube",   "crossing-quads", "receding-quads"};
constexpr const char* kLargeScenes[] = {"character", "runner", "wrecking-ball", "tree", "swaying-tree", "chess", "octopus"};

/// The kept scenes, and the others as small as they can be.
void make_every_scene(const std::filesystem::path& folder) {
    make_all(folder);
    make_character(folder / "character.gltf", {.triangles = 2000});
    make_runner(folder / "runner.gltf", {.triangles = 20000});
    make_wrecking_ball(folder / "wrecking-ball.gltf");
    make_tree(folder / "tree.gltf", {.leaves = 300});
    make_tree(folder / "swaying-tree.gltf", {.leaves = 300, .sway = 0.1});
    make_chess(folder / "chess.gltf", {.triangles = 10000});
    make_octopus(folder / "octopus.gltf", {.triangles = 50000});
}

class File : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        make_every_scene(folder_.path());
        document_ = Json::parse(bytes_of_file(folder_ / (std::string(GetParam()) + ".gltf")));
        bin_ = bytes_of_file(folder_ / document_["buffers"][0]["uri"].get<std::string>());
    }

    static std::size_t component_bytes(int type) { return type == 5126 || type == 5125 ? 4 : type == 5123 ? 2 : 1; }
    static std::size_t components(const std::string& type) {
        return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    }
    std::vector<float> floats(const Json& accessor) const {
        EXPECT_EQ(accessor["componentType"], 5126);
        const Json& view = document_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        std::vector<float> values(accessor["count"].get<std::size_t>() * components(accessor["type"]));
        const std::size_t offset = view["byteOffset"].get<std::size_t>() + accessor.value("byteOffset", std::size_t{0});
        std::memcpy(values.data(), bin_.data() + offset, values.size() * sizeof(float));
        return values;
    }
    void expect_bounds(const Json& accessor) const {
        const std::vector<float> values = floats(accessor);
        const std::size_t width = components(accessor["type"]);
        ASSERT_EQ(accessor["min"].size(), width);
        ASSERT_EQ(accessor["max"].size(), width);
        for (std::size_t c = 0; c < width; ++c) {
            float low = values[c], high = values[c];
            for (std::size_t i = c; i < values.size(); i += width) {
                low = std::min(low, values[i]);
                high = std::max(high, values[i]);
            }
            EXPECT_EQ(accessor["min"][c].get<double>(), static_cast<double>(low));
            EXPECT_EQ(accessor["max"][c].get<double>(), static_cast<double>(high));
        }
    }
    const Json& accessor(const Json& index) const { return document_["accessors"][index.get<std::size_t>()]; }

    Folder folder_;
    Json document_;
    std::string bin_;
};

TEST_P(File, AccessorsLieInTheirViewsAndAreAligned) {
    EXPECT_EQ(document_["buffers"][0]["byteLength"], bin_.size());
    for (const Json& view : document_["bufferViews"]) {
        EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), bin_.size());
        EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    }
    for (const Json& a : document_["accessors"]) {
        const Json& view = document_["bufferViews"][a["bufferView"].get<std::size_t>()];
        const std::size_t component = component_bytes(a["componentType"]), element = component * components(a["type"]);
        const std::size_t offset = a.value("byteOffset", std::size_t{0});
        EXPECT_LE(offset + element * a["count"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
        EXPECT_EQ((view["byteOffset"].get<std::size_t>() + offset) % component, 0u);
        if (view.value("target", 0) == 34962) {
            EXPECT_EQ(element % 4, 0u);
        }
    }
}

TEST_P(File, VerticesHaveBoundsUnitNormalsAndFullWeights) {
    for (const Json& mesh : document_["meshes"]) {
        for (const Json& primitive : mesh["primitives"]) {
            const std::size_t count = accessor(primitive["attributes"]["POSITION"])["count"];
            expect_bounds(accessor(primitive["attributes"]["POSITION"]));
            for (const auto& [name, index] : primitive["attributes"].items()) {
                EXPECT_EQ(accessor(index)["count"], count) << name;
                const Json& view = document_["bufferViews"][accessor(index)["bufferView"].get<std::size_t>()];
                EXPECT_EQ(view["target"], 34962) << name;
            }
            const Json& indices = accessor(primitive["indices"]);
            EXPECT_EQ(document_["bufferViews"][indices["bufferView"].get<std::size_t>()]["target"], 34963);
            EXPECT_EQ(indices["componentType"], count > 65535 ? 5125 : 5123);
            const std::vector<float> normals = floats(accessor(primitive["attributes"]["NORMAL"]));
            for (std::size_t i = 0; i < normals.size(); i += 3) {
                ASSERT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1.0f, 1e-5f);
            }
            if (!primitive["attributes"].contains("WEIGHTS_0")) continue;
            const std::vector<float> weights = floats(accessor(primitive["attributes"]["WEIGHTS_0"]));
            for (std::size_t i = 0; i < weights.size(); i += 4) {
                ASSERT_NEAR(weights[i] + weights[i + 1] + weights[i + 2] + weights[i + 3], 1.0f, 2e-7f);
            }
        }
    }
}

TEST_P(File, AnimationStartsAtZeroWithRisingTimesAndUnitRotations) {
    ASSERT_EQ(document_["animations"].size(), 1u);
    std::set<std::pair<std::size_t, std::string>> targets;
    for (const Json& channel : document_["animations"][0]["channels"]) {
        const std::string path = channel["target"]["path"];
        EXPECT_TRUE(targets.insert({channel["target"]["node"].get<std::size_t>(), path}).second) << "animated twice";
        const Json& sampler = document_["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
        const Json& input = accessor(sampler["input"]);
        const Json& output = accessor(sampler["output"]);
        expect_bounds(input);
        EXPECT_EQ(input["count"], output["count"]);
        const std::vector<float> times = floats(input);
        EXPECT_EQ(times.front(), 0.0f);
        EXPECT_GE(static_cast<double>(times.back()), kShutterSeconds);
        EXPECT_TRUE(std::is_sorted(times.begin(), times.end(), [](float a, float b) { return a <= b; }));
        if (path != "rotation") continue;
        const std::vector<float> q = floats(output);
        for (std::size_t i = 0; i < q.size(); i += 4) {
            ASSERT_NEAR(q[i] * q[i] + q[i + 1] * q[i + 1] + q[i + 2] * q[i + 2] + q[i + 3] * q[i + 3], 1.0f, 1e-5f);
        }
    }
}

TEST_P(File, NodesAreReachedOnceAndExtensionsAreNamed) {
    std::vector<int> reached(document_["nodes"].size(), 0);
    for (const Json& root : document_["scenes"][0]["nodes"]) ++reached[root.get<std::size_t>()];
    for (const Json& node : document_["nodes"]) {
        for (const Json& child : node.value("children", Json::array())) ++reached[child.get<std::size_t>()];
    }
    EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), static_cast<long>(reached.size()));
    EXPECT_EQ(document_["extensionsUsed"], Json::array({"KHR_lights_punctual"}));
    EXPECT_FALSE(document_["extensions"]["KHR_lights_punctual"]["lights"].empty());
}

TEST_P(File, IsTheSameEachTime) {
    const std::filesystem::path again = folder_ / "again";
    std::filesystem::create_directory(again);
    make_every_scene(again);
    for (const char* extension : {".gltf", ".bin"}) {
        const std::string name = std::string(GetParam()) + extension;
        EXPECT_EQ(bytes_of_file(folder_ / name), bytes_of_file(again / name));
    }
}

class KeptFile : public File {};

TEST_P(KeptFile, IsSmallEnoughToBeCommitted) {
    for (const char* extension : {".gltf", ".bin"}) {
        EXPECT_LT(std::filesystem::file_size(folder_ / (std::string(GetParam()) + extension)), 1000000u);
    }
}

INSTANTIATE_TEST_SUITE_P(Kept, File, testing::ValuesIn(kKeptScenes));
INSTANTIATE_TEST_SUITE_P(Large, File, testing::ValuesIn(kLargeScenes));
INSTANTIATE_TEST_SUITE_P(Makers, KeptFile, testing::ValuesIn(kKeptScenes));

TEST(FileNames, AreEncodedInTheUri) {
    const Folder folder;
    make_pillars(folder / "two words%.gltf", {.columns = 1});
    EXPECT_TRUE(std::filesystem::exists(folder / "two words%.bin"));
    const Json document = Json::parse(bytes_of_file(folder / "two words%.gltf"));
    EXPECT_EQ(document["buffers"][0]["uri"], "two%20words%25.bin");
}

}  // namespace
}  // namespace gnomon::makers
