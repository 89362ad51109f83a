// SPDX-License-Identifier: Apache-2.0
// `gnomon probe` as its users see it. Needs a Vulkan device; without one these tests say that they are skipped.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "io/exr.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::HasSubstr;
using Names = std::set<std::string>;

constexpr uint32_t kWidth = 40, kHeight = 30, kSpp = 8;

class CliProbeTest : public TestFolder {
protected:
    void SetUp() override { GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"})); }

    CommandResult run(const std::string& command, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {command, std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/scenes/figure.gltf",
                                             "--size=40x30", "--spp=8", "--shadow-res=48"});
        return run_gnomon(folder, arguments);
    }

    json probe(std::vector<std::string> arguments) {
        arguments.emplace_back("--json=-");
        const CommandResult result = run("probe", arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.exit_code == 0 ? json::parse(result.out) : json();
    }

    static std::string place_text(uint32_t x, uint32_t y) { return std::to_string(x) + "," + std::to_string(y); }
};

// The samples of a pixel are those of its visibility, and what hides a dark one is a range of its texel at its time.
TEST_F(CliProbeTest, OfAPixelIsWhatThePictureShows) {
    for (const std::string method : {"exact", "dtr-analytic"}) {
        ASSERT_EQ(run("render", {"-o", "a.exr", "--method", method, "--quiet"}).exit_code, 0);
        const io::ExrImage image = io::read_exr(folder / "a.exr");
        const std::vector<float>&alpha = image.find("A")->values, &visibility = image.find("visibility.0")->values;
        // Some that are lit, some that are dark, some of both.
        uint32_t kinds[3] = {}, dark = 0, hidden = 0, turned = 0;
        for (uint32_t i = 0; i < kWidth * kHeight; i += 7) {
            if (alpha[i] < 1.0f) continue;
            const size_t kind = visibility[i] == 1.0f ? 0 : (visibility[i] == 0.0f ? 1 : 2);
            if (++kinds[kind] > 3) continue;
            const json found = probe({"--method", method, "--pixel", place_text(i % kWidth, i / kWidth)});
            uint32_t here = 0, lit = 0;
            for (const json& texel : found["texels"]) {
                for (const json& sample : texel["samples"]) {
                    EXPECT_EQ(sample["pixel"], json({i % kWidth, i / kWidth}));
                    ++here;
                    lit += sample["lit"] ? 1 : 0;
                    dark += sample["lit"] ? 0 : 1;
                    if (sample["shadowed_by"].is_null()) {
                        turned += !sample["lit"] && sample["turned_away"] ? 1 : 0;
                        continue;
                    }
                    ++hidden;
                    EXPECT_FALSE(sample["lit"]);
                    EXPECT_LT(sample["shadow_depth"], sample["depth"]);
                    bool listed = false;
                    for (const json& range : texel["ranges"])
                        listed = listed || (range["triangle"] == sample["shadowed_by"] && range["enter"] <= sample["time"] &&
                                            sample["time"] <= range["exit"]);
                    EXPECT_TRUE(listed) << sample;
                }
            }
            EXPECT_EQ(here, kSpp);
            EXPECT_NEAR(double(lit) / kSpp, visibility[i], 1e-6) << i;
        }
        for (const uint32_t count : kinds) EXPECT_GT(count, 0u) << method;
        EXPECT_GT(dark, 5u) << method;
        EXPECT_GT(hidden, 5u) << method;
        EXPECT_GE(hidden + turned, dark * 9 / 10) << method;
    }
}

// Both ways to ask meet.
TEST_F(CliProbeTest, OfATexelHasTheSamplesOfThePixel) {
    const json pixel = probe({"--pixel=20,24"});
    ASSERT_FALSE(pixel["texels"].empty());
    const json& first = pixel["texels"][0];
    const std::string place = first["texel"][0].dump() + "," + first["texel"][1].dump();
    const json texel = probe({"--texel", place});
    ASSERT_EQ(texel["texels"].size(), 1u);
    EXPECT_EQ(texel["texels"][0]["ranges"], first["ranges"]);
    for (const json& sample : first["samples"]) EXPECT_THAT(texel["texels"][0]["samples"], ::testing::Contains(sample));
}

TEST_F(CliProbeTest, DrawsADiagram) {
    const CommandResult result = run("probe", {"--pixel=20,24", "-o", "a.svg", "--json", "a.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(names(), (Names{"a.json", "a.svg"}));
    EXPECT_THAT(result.out, HasSubstr("samples ask"));
    const std::string svg = content_of(folder / "a.svg");
    const json found = json::parse(content_of(folder / "a.json"));
    EXPECT_THAT(svg, HasSubstr("figure.gltf, light 0, pixel 20,24, texel "));
    EXPECT_THAT(svg, HasSubstr("time, shares of the shutter (0 s to 0.0208333 s)"));
    EXPECT_THAT(svg, HasSubstr("depth along the light's axis, m"));
    size_t samples = 0, drawn = 0;
    for (const json& texel : found["texels"]) samples += texel["samples"].size();
    for (size_t at = svg.find("r=\"4\" class=\""); at != std::string::npos; at = svg.find("r=\"4\" class=\"", at + 1)) ++drawn;
    EXPECT_EQ(drawn, samples + 2 * found["texels"].size());  // And the legends'.
}

TEST_F(CliProbeTest, WhatCannotBeIsAUsageError) {
    const auto expect_usage = [&](const std::vector<std::string>& arguments, const std::string& text) {
        const CommandResult result = run("probe", arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.err, HasSubstr(text));
    };
    expect_usage({}, "use --texel X,Y or --pixel X,Y");
    expect_usage({"--pixel=1,1", "--texel=1,1"}, "--texel");
    expect_usage({"--pixel=40,1"}, "40,1 is outside of 40 x 30, --pixel; use 0,0 to 39,29");
    expect_usage({"--texel=1,48"}, "1,48 is outside of 48 x 48, --texel");
    expect_usage({"--texel=1"}, "'1' is no place");
    expect_usage({"--texel=1,1", "--light=9"}, "there is no light 9");
    expect_usage({"--texel=1,1", "--method=tsm"}, "method tsm has no S-buffer");
    expect_usage({"--texel=1,1", "-o", "a.png"}, "a.png");
}

}  // namespace gnomon::test
