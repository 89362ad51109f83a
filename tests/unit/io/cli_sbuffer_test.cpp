// SPDX-License-Identifier: Apache-2.0
// `gnomon render --dump-sbuffer` and `gnomon sbuffer` as their users see them. Rendering needs a Vulkan device; without one
// those tests say that they are skipped.
#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "io/exr.hpp"
#include "io/sbuffer_file.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::HasSubstr;
using Names = std::set<std::string>;

class CliSBufferTest : public TestFolder {
protected:
    CommandResult sbuffer(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "sbuffer");
        return run_gnomon(folder, arguments);
    }
};

class CliDumpTest : public CliSBufferTest {
protected:
    void SetUp() override { GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"})); }

    CommandResult dump(const std::string& scene, std::vector<std::string> arguments) {
        const std::string path = std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/scenes/" + scene + ".gltf";
        arguments.insert(arguments.begin(), {"render", path, "-o", "a.exr", "--size=16x16", "--spp=1", "--shadow-res=64"});
        return run_gnomon(folder, arguments);
    }
};

TEST_F(CliSBufferTest, PrintsAndCounts) {
    io::write_sbuffer(folder / "a.exr", {2, 2, 1, false, {{1, 0.0f, 5, 0.5f, 2.0f, 2.0f}, {1, 0.25f, 2, 1.0f, 4.0f, 4.0f}}},
                      {{"gnomon:scene", "x.gltf"}, {"gnomon:light", "1"}, {"gnomon:effective.layout", "array"}});
    const CommandResult result = sbuffer({"a.exr"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("x.gltf, light 1,"));
    EXPECT_THAT(result.out, HasSubstr("0.5 mean, 2 at most, in texel 1,0"));
    EXPECT_THAT(result.out, HasSubstr("2 to 3 ranges:          1 texels,  25.00 %"));
    const CommandResult machine = sbuffer({"a.exr", "--json", "-"});
    const json document = json::parse(machine.out);
    EXPECT_EQ(document["schema"], "gnomon.sbuffer");
    EXPECT_EQ(document["settings"]["effective.layout"], "array");
    EXPECT_EQ(document["ranges"], 2);
    EXPECT_EQ(document["ranges_per_texel"], json({{"mean", 0.5}, {"max", 2}, {"max_at", {1, 0}}}));
    EXPECT_EQ(document["histogram"].back(), json({{"from", 2}, {"to", 3}, {"texels", 1}}));
    EXPECT_EQ(document["depth"], json({2.0, 4.0}));
}

TEST_F(CliSBufferTest, DamageIsAnInputErrorThatNamesTexelAndRange) {
    io::write_sbuffer(folder / "a.exr", {2, 2, 1, false, {{2, 0.0f, 5, 0.5f, 2.0f, 2.0f}, {2, 0.75f, 2, 0.5f, 4.0f, 4.0f}}},
                      {});
    const CommandResult result = sbuffer({"a.exr", "--json=a.json"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err,
                HasSubstr("error: texel 0,1, range 1 of 2: it enters at 0.75 and leaves before, at 0.5, a.exr; make"));
    EXPECT_EQ(names(), Names{"a.exr"});
}

TEST_F(CliDumpTest, OfOneLightIsTheFileOfSeveralOneForEach) {
    const CommandResult one = dump("two-cubes", {"--dump-sbuffer", "s.exr", "--json=a.json", "--pages=asked"});
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(one.err, HasSubstr("all pages are made"));
    EXPECT_EQ(names(), (Names{"a.exr", "a.json", "s.exr"}));
    const json document = json::parse(content_of(folder / "a.json"));
    EXPECT_EQ(document["outputs"], json({"a.exr", "s.exr"}));
    const CommandResult checked = sbuffer({"s.exr", "--json=-"});
    ASSERT_EQ(checked.exit_code, 0) << checked.err;
    const json found = json::parse(checked.out);
    EXPECT_EQ(found["width"], 64);
    EXPECT_EQ(found["ranges"], document["counts"]["ranges.0"]);
    EXPECT_EQ(found["settings"]["scene"], "two-cubes.gltf");
    EXPECT_EQ(found["settings"]["light"], "0");
    EXPECT_GT(found["ranges"], 100);

    const CommandResult three = dump("pillars", {"--dump-sbuffer", "p.exr", "--method=dtr", "--quiet"});
    ASSERT_EQ(three.exit_code, 0) << three.err;
    size_t lights = 0;
    for (const std::string& name : names()) lights += name.starts_with("p.light") ? 1 : 0;
    const std::string first = lights > 1 ? "p.light0.exr" : "p.exr";
    EXPECT_EQ(sbuffer({first}).exit_code, 0);
    EXPECT_TRUE(io::SBufferFile(folder / first).exit_depths());
}

TEST_F(CliDumpTest, ThePictureIsTheSame) {
    ASSERT_EQ(dump("two-cubes", {"--method=dtr"}).exit_code, 0);
    const io::ExrImage without = io::read_exr(folder / "a.exr");
    ASSERT_EQ(dump("two-cubes", {"--method=dtr", "--dump-sbuffer=s.exr"}).exit_code, 0);
    const io::ExrImage with = io::read_exr(folder / "a.exr");
    for (size_t i = 0; i < with.channels.size(); ++i) EXPECT_EQ(with.channels[i].values, without.channels[i].values);
}

TEST_F(CliDumpTest, Heatmap) {
    ASSERT_EQ(dump("two-cubes", {"--heatmap", "h.png", "--json=a.json"}).exit_code, 0);
    EXPECT_EQ(names(), (Names{"a.exr", "a.json", "h.png"}));
    EXPECT_EQ(json::parse(content_of(folder / "a.json"))["outputs"], json({"a.exr", "h.png"}));
    const std::string png = content_of(folder / "h.png");
    ASSERT_EQ(png.substr(1, 3), "PNG");
    EXPECT_GT(static_cast<uint8_t>(png[19]), 64);  // Its width: the view's and the scale's.
    EXPECT_EQ(dump("two-cubes", {"--heatmap=h.png", "--png=h.png"}).exit_code, 2);
    EXPECT_EQ(dump("two-cubes", {"--heatmap=h.exr"}).exit_code, 2);
}

TEST_F(CliDumpTest, Sequence) {
    const std::string path = std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/scenes/two-cubes.gltf";
    const CommandResult result = run_gnomon(folder, {"render", path, "-o", "a.##.exr", "--dump-sbuffer", "s.##.exr",
                                                     "--frames=3-4", "--size=8x8", "--spp=1", "--shadow-res=32"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(names(), (Names{"a.03.exr", "a.04.exr", "s.03.exr", "s.04.exr"}));
}

TEST_F(CliDumpTest, WhatCannotBeIsAUsageError) {
    const CommandResult tsm = dump("two-cubes", {"--dump-sbuffer=s.exr", "--method=tsm"});
    EXPECT_EQ(tsm.exit_code, 2);
    EXPECT_THAT(tsm.err, HasSubstr("method tsm has no S-buffer, --dump-sbuffer"));
    EXPECT_EQ(dump("two-cubes", {"--dump-sbuffer=a.exr"}).exit_code, 2);
    EXPECT_EQ(dump("two-cubes", {"--dump-sbuffer=s.png"}).exit_code, 2);
    EXPECT_EQ(names(), Names{});
}

// Another reader than OpenEXR's own classes.
TEST_F(CliDumpTest, OpenImageIoReadsIt) {
    if (std::system("oiiotool --help > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "skipped: no oiiotool; it is in Debian's openimageio-tools";
    ASSERT_EQ(dump("two-cubes", {"--dump-sbuffer=s.exr"}).exit_code, 0);
    const auto output_of = [&](const std::string& command) {
        EXPECT_EQ(std::system(("cd '" + folder.string() + "' && " + command + " > out.txt 2>&1").c_str()), 0);
        return content_of(folder / "out.txt");
    };
    const std::string info = output_of("oiiotool --info -v s.exr");
    EXPECT_THAT(info, HasSubstr("64 x   64, 6 channel, deep float"));
    for (const char* text : {"compression: \"zips\"", "time.enter", "time.exit", "triangle", "ZBack", "gnomon:light: \"0\""})
        EXPECT_THAT(info, HasSubstr(text));
    const std::string data = output_of("oiiotool --dumpdata:empty=0 s.exr");
    const json found = json::parse(sbuffer({"s.exr", "--json=-"}).out);
    size_t samples = 0;
    for (size_t at = data.find(" A=1 Z="); at != std::string::npos; at = data.find(" A=1 Z=", at + 1)) ++samples;
    EXPECT_EQ(samples, found["ranges"]) << data.substr(0, 1000);
}

}  // namespace gnomon::test
