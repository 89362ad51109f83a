// SPDX-License-Identifier: Apache-2.0
// The values of options, from text.
#include "options.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "throws.hpp"

namespace gnomon::test {

namespace {

/// Every text is refused with an error that names the option.
template <class Parse>
void expect_refused(Parse parse, std::initializer_list<const char*> texts) {
    for (const char* text : texts) {
        SCOPED_TRACE(text);
        EXPECT_GNOMON_ERROR(parse(text, "--option"), ErrorKind::usage, ", --option; ");
    }
}

}  // namespace

TEST(Options, Count) {
    EXPECT_EQ(cli::parse_count("1", "--spp", 1, 10), 1u);
    EXPECT_EQ(cli::parse_count("10", "--spp", 1, 10), 10u);
    EXPECT_EQ(cli::parse_count("010", "--spp", 1, 10), 10u);  // Decimal, not octal.
    EXPECT_EQ(cli::parse_count("4294967295", "--seed", 0, std::numeric_limits<uint32_t>::max()), 4294967295u);
    const auto parse = [](const std::string& text, const std::string& option) { return cli::parse_count(text, option, 1, 10); };
    expect_refused(parse, {"0", "11", "", "-1", "1.0", "1e1", "0x1", " 1", "1 ", "4294967297", "99999999999999999999", "many"});
}

TEST(Options, Number) {
    EXPECT_EQ(cli::parse_number("-1.5", "--exposure", -2.0, 2.0), -1.5);
    EXPECT_EQ(cli::parse_number("2e0", "--exposure", -2.0, 2.0), 2.0);
    const auto parse = [](const std::string& text, const std::string& option) {
        return cli::parse_number(text, option, 0.0, 360.0);
    };
    expect_refused(parse, {"", "nan", "inf", "-0.1", "360.1", "1,5", "1s"});
}

TEST(Options, Size) {
    const cli::Size size = cli::parse_size("1280x720", "--size");
    EXPECT_EQ(size.width, 1280u);
    EXPECT_EQ(size.height, 720u);
    EXPECT_EQ(cli::parse_size("1x16384", "--size").height, 16384u);
    expect_refused(cli::parse_size, {"", "x", "1280", "1280x", "x720", "0x720", "1280x0", "16385x1", "1x16385", "-1x2",
                                     "1280X720", "1280*720", "1280x720x3", "12.5x7", "4294967297x1"});
}

TEST(Options, Shutter) {
    const cli::Shutter shutter = cli::parse_shutter("-0.5:1e-2", "--shutter");
    EXPECT_EQ(shutter.open, -0.5);
    EXPECT_EQ(shutter.close, 0.01);
    const cli::Shutter still = cli::parse_shutter("2:2", "--shutter");
    EXPECT_EQ(still.open, still.close);
    expect_refused(cli::parse_shutter, {"", ":", "0", "0:", ":1", "1:0", "0:nan", "0:inf", "-inf:0", "0:1:2", "0-1", "a:b"});
}

TEST(Options, Frames) {
    const cli::FrameRange range = cli::parse_frames("3-47", "--frames");
    EXPECT_EQ(range.first, 3u);
    EXPECT_EQ(range.last, 47u);
    EXPECT_EQ(cli::parse_frames("5-5", "--frames").last, 5u);
    EXPECT_EQ(cli::parse_frames("4294867296-4294967295", "--frames").last, 4294967295u);
    expect_refused(cli::parse_frames,
                   {"", "-", "5", "5-", "-5", "7-3", "0-100000", "0-4294967295", "0-4294967296", "a-b", "1-2-3", "1.5-2"});
}

TEST(Options, Bytes) {
    EXPECT_EQ(cli::parse_bytes("1", "--memory-budget"), 1u);
    EXPECT_EQ(cli::parse_bytes("2000000B", "--memory-budget"), 2000000u);
    EXPECT_EQ(cli::parse_bytes("512M", "--memory-budget"), 536870912u);
    EXPECT_EQ(cli::parse_bytes("2g", "--memory-budget"), 2147483648u);
    EXPECT_EQ(cli::parse_bytes("1.5GiB", "--memory-budget"), 1610612736u);
    EXPECT_EQ(cli::parse_bytes("3kB", "--memory-budget"), 3000u);
    EXPECT_EQ(cli::parse_bytes("1TB", "--memory-budget"), 1000000000000u);
    expect_refused(cli::parse_bytes, {"", "0", "0.5", "M", "-1M", "1X", "1MM", "1 M", "1Mi", "1.5.5M", "1e3", "9999999999T"});
}

TEST(Options, Ground) {
    EXPECT_EQ(cli::parse_ground("auto", "--ground"), std::nullopt);
    EXPECT_EQ(cli::parse_ground("-2.5", "--ground"), -2.5f);
    expect_refused(cli::parse_ground, {"", "Auto", "nan", "inf", "1e39", "2m"});
}

TEST(Options, Ending) {
    EXPECT_NO_THROW(cli::check_ending("a/b.c.exr", ".exr", "-o"));
    EXPECT_NO_THROW(cli::check_ending("B.EXR", ".exr", "-o"));
    const auto check = [](const std::string& text, const std::string& option) { cli::check_ending(text, ".exr", option); };
    expect_refused(check, {"", "a", "a.png", "a.exr.png", "a.exr/b", "exr", ".exr"});
}

TEST(Options, NumberedPath) {
    EXPECT_EQ(cli::numbered_path("out/f_####.exr", 7, "-o"), "out/f_0007.exr");
    EXPECT_EQ(cli::numbered_path("####", 12345, "-o"), "12345");
    EXPECT_EQ(cli::numbered_path("a##b.exr", 7, "-o"), "a07b.exr");
    const auto number = [](const std::string& text, const std::string& option) { return cli::numbered_path(text, 1, option); };
    expect_refused(number, {"", "f.exr", "####/f.exr", "##_##.exr"});
}

TEST(Options, ChooseCamera) {
    Scene scene;
    EXPECT_GNOMON_ERROR(cli::choose_camera(scene, "0"), ErrorKind::usage, "no cameras");
    for (const char* name : {"front", "1", "twin", "twin"}) scene.cameras.push_back({.name = name});
    EXPECT_EQ(cli::choose_camera(scene, "front"), 0u);
    EXPECT_EQ(cli::choose_camera(scene, "1"), 1u);  // Also its name.
    EXPECT_EQ(cli::choose_camera(scene, "3"), 3u);
    EXPECT_GNOMON_ERROR(cli::choose_camera(scene, "twin"), ErrorKind::usage, "several cameras");
    EXPECT_GNOMON_ERROR(cli::choose_camera(scene, "4"), ErrorKind::usage, "0 'front', 1 '1', 2 'twin', 3 'twin'");
    EXPECT_GNOMON_ERROR(cli::choose_camera(scene, "back"), ErrorKind::usage, "there is no camera 'back', --camera; ");
}

TEST(Options, FilesOfLights) {
    EXPECT_EQ(cli::light_path("a/ranges.exr", 0, 1), "a/ranges.exr");
    EXPECT_EQ(cli::light_path("a.b/ranges.0001.exr", 12, 13), "a.b/ranges.0001.light12.exr");
}

}  // namespace gnomon::test
