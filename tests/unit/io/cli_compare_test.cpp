// SPDX-License-Identifier: Apache-2.0
// `gnomon compare` as its users see it.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "io/exr.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CliCompareTest : public TestFolder {
protected:
    CliCompareTest() {
        io::write_exr(folder / "a.exr", 2, 1, std::vector<Channel>{{"R", {1.0f, 2.0f}}, {"Z", {5.0f, 5.0f}}}, {});
        io::write_exr(folder / "b.exr", 2, 1, std::vector<Channel>{{"R", {1.5f, 1.5f}}, {"Z", {5.0f, 5.0f}}}, {});
        io::write_exr(folder / "only_r.exr", 2, 1, std::vector<Channel>{{"R", {1.0f, 2.0f}}}, {});
        io::write_exr(folder / "only_z.exr", 2, 1, std::vector<Channel>{{"Z", {1.0f, 2.0f}}}, {});
        io::write_exr(folder / "wide.exr", 3, 1, std::vector<Channel>{{"R", {1.0f, 2.0f, 3.0f}}}, {});
    }

    CommandResult compare(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "compare");
        return run_gnomon(folder, arguments);
    }
};

TEST_F(CliCompareTest, TableOnStdout) {
    const CommandResult result = compare({"a.exr", "b.exr"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out,
              "channel        bias     s.e.         RMSE     s.e. noise <=          max   PSNR dB relative MSE  not finite\n"
              // Less the mean, 0, the two differences are -0.5 and 0.5. 20 log10(1.5 / 0.5); 0.25 / 2.26.
              "R                 0      0.5          0.5        0        -          0.5      9.54     0.110619           0\n"
              "Z                 0        0            0        0        -            0       inf            0           0\n");
}

TEST_F(CliCompareTest, Hashes) {
    io::write_exr(folder / "same.exr", 2, 1, std::vector<Channel>{{"Z", {5.0f, 5.0f}}, {"R", {1.0f, 2.0f}}},
                  {{"gnomon:scene", "another"}});
    const CommandResult one = compare({"--hash", "a.exr"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(one.out, ::testing::MatchesRegex("[0-9a-f]+  a.exr\n"));
    const std::string hash = one.out.substr(0, 16);
    const CommandResult same = compare({"--hash", "a.exr", "same.exr"});
    EXPECT_EQ(same.exit_code, 0);
    EXPECT_EQ(same.out, hash + "  a.exr\n" + hash + "  same.exr\n");
    const CommandResult differ = compare({"--hash", "a.exr", "same.exr", "b.exr", "--json=-"});
    EXPECT_EQ(differ.exit_code, 8);
    const json document = json::parse(differ.out);
    EXPECT_EQ(document["schema"], "gnomon.hashes");
    EXPECT_EQ(document["files"][1], json({{"path", "same.exr"}, {"hash", hash}}));
    EXPECT_NE(document["files"][2]["hash"], hash);
    EXPECT_EQ(document["same"], false);
    EXPECT_EQ(compare({"--hash", "a.exr", "b.exr", "--channels=Z"}).exit_code, 0);
    EXPECT_EQ(compare({"--hash", "a.exr", "only_r.exr"}).exit_code, 8);
    EXPECT_EQ(compare({"--hash", "a.exr", "only_r.exr", "--channels=R"}).exit_code, 0);
    EXPECT_EQ(compare({"--hash", "a.exr", "only_r.exr", "--channels=Z"}).exit_code, 3);
    EXPECT_EQ(compare({"--hash", "a.exr", "b.exr", "--threshold=1"}).exit_code, 2);
    EXPECT_EQ(compare({"--hash", "a.exr", "none.exr"}).exit_code, 3);
}

TEST_F(CliCompareTest, NamesADifferenceOfDriver) {
    const auto write = [&](const char* name, const std::map<std::string, std::string>& attributes) {
        io::write_exr(folder / name, 2, 1, std::vector<Channel>{{"R", {1.0f, 2.0f}}}, attributes);
    };
    write("old.exr", {{"gnomon:driver", "maker 1.2"}});
    write("new.exr", {{"gnomon:driver", "maker 1.3"}});
    write("none.exr", {});
    const CommandResult differ = compare({"old.exr", "new.exr", "--json=-", "--threshold=0"});
    EXPECT_EQ(differ.exit_code, 0);
    EXPECT_THAT(
        differ.err,
        HasSubstr("gnomon: warning: the images are of different drivers: old.exr of maker 1.2, new.exr of maker 1.3\n"));
    EXPECT_EQ(json::parse(differ.out)["drivers"], json({{"a", "maker 1.2"}, {"b", "maker 1.3"}, {"differ", true}}));
    for (const char* other : {"old.exr", "none.exr"}) {
        const CommandResult same = compare({"old.exr", other, "--json=-"});
        EXPECT_EQ(same.err, "");
        EXPECT_EQ(json::parse(same.out)["drivers"]["differ"], false);
    }
    EXPECT_EQ(json::parse(compare({"old.exr", "none.exr", "--json=-"}).out)["drivers"]["b"], nullptr);
}

TEST_F(CliCompareTest, Thresholds) {
    EXPECT_EQ(compare({"a.exr", "a.exr", "--threshold", "0"}).exit_code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold", "0.5"}).exit_code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=0.49"}).exit_code, 8);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=0.49", "--channels=Z"}).exit_code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=0.49", "--channels=Z,R"}).exit_code, 8);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=9.5", "--metric=psnr"}).exit_code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=9.6", "--metric=psnr"}).exit_code, 8);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=0.11", "--metric=relmse"}).exit_code, 8);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=0.12", "--metric=relmse"}).exit_code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--threshold=0.5", "--metric=max"}).exit_code, 0);
}

TEST_F(CliCompareTest, JsonOnStdoutIsNothingElse) {
    const CommandResult result = compare({"a.exr", "b.exr", "--json=-", "--threshold=0.1"});
    EXPECT_EQ(result.exit_code, 8);
    const json document = json::parse(result.out);
    EXPECT_EQ(document["schema"], "gnomon.compare");
    EXPECT_EQ(document["over_threshold"], true);
    EXPECT_EQ(document["channels"][0]["name"], "R");
    EXPECT_EQ(document["channels"][0]["bias"], 0.0);
    EXPECT_EQ(document["channels"][0]["bias_standard_error"], 0.5);
    EXPECT_EQ(document["channels"][0]["rmse"], 0.5);
    EXPECT_EQ(document["channels"][0]["rmse_standard_error"], 0.0);
    EXPECT_EQ(document["channels"][0]["noise"], nullptr);
    EXPECT_EQ(document["channels"][1]["psnr"], nullptr);
}

// The standard errors of the pixels are 0.25 in one image and 0 in the other: 1/16 of variance in 1/4 of rmse^2.
TEST_F(CliCompareTest, NoiseOfVisibilities) {
    const auto write = [&](const char* name, float visibility, float error, const std::string& seed, const std::string& spp) {
        io::write_exr(folder / name, 2, 1,
                      std::vector<Channel>{{"visibility.0", {visibility, 0.5f}}, {"visibility_var.0", {error, error}}},
                      {{"gnomon:seed", seed}, {"gnomon:spp", spp}});
    };
    write("seed1.exr", 1.0f, 0.25f, "1", "4");
    write("seed2.exr", 0.5f, 0.0f, "2", "64");
    write("one.exr", 1.0f, 0.0f, "1", "1");
    const auto noise = [&](const char* a, const char* b) {
        return json::parse(compare({a, b, "--json=-"}).out)["channels"][0]["noise"];
    };
    EXPECT_EQ(noise("seed1.exr", "seed2.exr")["variance"], 0.0625);
    EXPECT_EQ(noise("seed1.exr", "seed2.exr")["share"], 0.5);
    EXPECT_EQ(noise("seed1.exr", "seed2.exr")["mse_without"], 0.0625);
    EXPECT_EQ(noise("one.exr", "seed2.exr"), nullptr);  // One sample does not tell.
    EXPECT_EQ(noise("one.exr", "seed1.exr"), nullptr);  // Nor do samples that may be the same.
    EXPECT_THAT(compare({"seed1.exr", "seed2.exr"}).out, HasSubstr("50.0 %"));
    EXPECT_THAT(compare({"one.exr", "seed1.exr"}).err, HasSubstr("info: both images have seed 1"));
}

// A second render, 0.5 away in one of two pixels: 1/16 of variance, and half of what that pixel is away as the standard error
// of the mean of two, over sqrt(2).
TEST_F(CliCompareTest, SecondRender) {
    const auto write = [&](const char* name, float value, const std::string& seed, const std::string& spp) {
        io::write_exr(folder / name, 2, 1, std::vector<Channel>{{"R", {value, 1.0f}}},
                      {{"gnomon:seed", seed}, {"gnomon:spp", spp}});
    };
    write("first.exr", 1.0f, "1", "4");
    write("second.exr", 0.5f, "2", "4");
    write("more.exr", 0.5f, "2", "8");
    write("reference.exr", 0.0f, "1", "4");
    const CommandResult result = compare({"first.exr", "reference.exr", "--again=second.exr", "--json=-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json channel = json::parse(result.out)["channels"][0];
    EXPECT_EQ(channel["noise"]["variance"], 0.0625);
    EXPECT_NEAR(channel["bias_standard_error"].get<double>(), 0.25 / std::sqrt(2.0), 1e-12);
    EXPECT_THAT(compare({"first.exr", "reference.exr", "--again=second.exr"}).out, HasSubstr("   noise   "));

    const CommandResult same = compare({"first.exr", "reference.exr", "--again=first.exr"});
    EXPECT_EQ(same.exit_code, 3);
    EXPECT_THAT(same.err, HasSubstr("both renders have seed 1"));
    const CommandResult other = compare({"first.exr", "reference.exr", "--again=more.exr"});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_THAT(other.err, HasSubstr("differ in more than the seed: in gnomon:spp"));
    EXPECT_EQ(compare({"first.exr", "reference.exr", "--again=only_z.exr"}).exit_code, 3);
}

TEST_F(CliCompareTest, DifferenceImages) {
    EXPECT_EQ(compare({"a.exr", "b.exr", "--diff=d.exr", "--diff-png=d.png"}).exit_code, 0);
    const io::ExrImage image = io::read_exr(folder / "d.exr");
    ASSERT_NE(image.find("R"), nullptr);
    EXPECT_THAT(image.find("R")->values, ElementsAre(-0.5f, 0.5f));
    EXPECT_THAT(image.find("Z")->values, ElementsAre(0.0f, 0.0f));
    EXPECT_EQ(content_of(folder / "d.png").substr(1, 3), "PNG");
}

// Black and white: FLIP 0.9674 and SSIM 1e-4 / 1.0001 (see perceived_error_test.cpp).
TEST_F(CliCompareTest, WhatPicturesLookLike) {
    for (const auto& [name, value] : {std::pair("black.exr", 0.0f), std::pair("white.exr", 1.0f)}) {
        const std::vector<float> values(12 * 12, value);
        io::write_exr(folder / name, 12, 12, std::vector<Channel>{{"R", values}, {"G", values}, {"B", values}}, {});
    }
    const CommandResult result = compare({"white.exr", "black.exr", "--json=-", "--flip-png=f.png"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json document = json::parse(result.out);
    EXPECT_NEAR(document["flip"]["mean"].get<double>(), 0.9674, 5e-4);
    EXPECT_NEAR(document["ssim"].get<double>(), 1e-4 / 1.0001, 1e-9);
    EXPECT_EQ(content_of(folder / "f.png").substr(1, 3), "PNG");
    EXPECT_THAT(compare({"white.exr", "black.exr"}).out, HasSubstr("FLIP 0.967"));
    EXPECT_EQ(compare({"white.exr", "black.exr", "--metric=flip", "--threshold=0.97"}).exit_code, 0);
    EXPECT_EQ(compare({"white.exr", "black.exr", "--metric=flip", "--threshold=0.96"}).exit_code, 8);
    EXPECT_EQ(compare({"white.exr", "black.exr", "--metric=ssim", "--threshold=0.5"}).exit_code, 8);
    EXPECT_EQ(compare({"white.exr", "white.exr", "--metric=ssim", "--threshold=0.999"}).exit_code, 0);

    const CommandResult without = compare({"a.exr", "b.exr", "--metric=flip", "--threshold=1"});
    EXPECT_EQ(without.exit_code, 3);
    EXPECT_THAT(without.err, HasSubstr("FLIP and SSIM need the channels R, G and B"));
}

TEST_F(CliCompareTest, DifferentSizesExitWith3) {
    const CommandResult result = compare({"a.exr", "wide.exr"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("2x1 and 3x1"));
}

TEST_F(CliCompareTest, ChannelsOnOneSideAreNamed) {
    for (const auto& [a, b] : {std::pair("a.exr", "only_r.exr"), std::pair("only_r.exr", "a.exr")}) {
        const CommandResult result = compare({a, b});
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_EQ(result.err, "gnomon: warning: channel Z is not compared: only_r.exr has none\n");
    }
    const CommandResult none = compare({"only_r.exr", "only_z.exr"});
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_THAT(none.err, HasSubstr("no channel in common: R and Z"));
    const CommandResult asked = compare({"a.exr", "only_r.exr", "--channels=R,Z"});
    EXPECT_EQ(asked.exit_code, 3);
    EXPECT_THAT(asked.err, HasSubstr("no channel Z, only_r.exr; it has R"));
}

TEST_F(CliCompareTest, NanIsReportedAndOverAnyThreshold) {
    io::write_exr(folder / "nan.exr", 2, 1, std::vector<Channel>{{"R", {std::nanf(""), 2.0f}}}, {});
    const CommandResult result = compare({"nan.exr", "only_r.exr", "--threshold=100"});
    EXPECT_EQ(result.exit_code, 8);
    EXPECT_THAT(result.err, HasSubstr("channel R has 1 values that are not finite"));
}

TEST_F(CliCompareTest, PicturesThatAreNotFiniteAreOverAnyThreshold) {
    const std::vector<float> grey(12 * 12, 0.5f), nan(12 * 12, std::nanf(""));
    std::vector<float> spot = grey;
    spot[7] = INFINITY;
    const auto write = [&](const char* name, const std::vector<float>& red) {
        io::write_exr(folder / name, 12, 12, std::vector<Channel>{{"R", red}, {"G", grey}, {"B", grey}}, {});
    };
    write("grey.exr", grey);
    write("spot.exr", spot);
    io::write_exr(folder / "nan.exr", 12, 12, std::vector<Channel>{{"R", nan}, {"G", nan}, {"B", nan}}, {});
    for (const char* metric : {"--metric=flip", "--metric=ssim"}) {
        const std::string threshold = metric == std::string("--metric=flip") ? "--threshold=1" : "--threshold=0";
        EXPECT_EQ(compare({"grey.exr", "grey.exr", metric, threshold}).exit_code, 0) << metric;
        for (const auto& [a, b] :
             {std::pair("nan.exr", "grey.exr"), {"grey.exr", "nan.exr"}, {"nan.exr", "nan.exr"}, {"spot.exr", "grey.exr"}})
            EXPECT_EQ(compare({a, b, metric, threshold}).exit_code, 8) << metric << " " << a << " " << b;
    }
    const CommandResult result = compare({"nan.exr", "spot.exr", "--json=-"});
    EXPECT_EQ(json::parse(result.out)["flip"]["not_finite"], 3 * 144 + 1);
    EXPECT_THAT(result.err, HasSubstr("433 values of R, G and B are not finite"));
}

TEST_F(CliCompareTest, QuietLeavesErrorsOnly) {
    EXPECT_EQ(compare({"a.exr", "only_r.exr", "--quiet"}).err, "");
    EXPECT_THAT(compare({"a.exr", "none.exr", "--quiet"}).err, HasSubstr("gnomon: error: "));
}

}  // namespace gnomon::test
