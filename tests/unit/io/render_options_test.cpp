// SPDX-License-Identifier: Apache-2.0
// The options of `gnomon render`, and the frames that they ask for.
#include "render_options.hpp"

#include <gmock/gmock.h>

#include "throws.hpp"

namespace gnomon::test {

using cli::RenderOptions;

namespace {

RenderOptions parse(std::vector<std::string> arguments) {
    RenderOptions options;
    CLI::App app;
    cli::bind_render_options(app, options);
    std::reverse(arguments.begin(), arguments.end());  // As CLI11 wants them.
    app.parse(arguments);
    return options;
}

}  // namespace

TEST(RenderOptions, DefaultsAreThoseOfTheContract) {
    const RenderOptions options = parse({"a.glb", "-o", "a.exr"});
    EXPECT_EQ(options.scene, "a.glb");
    EXPECT_EQ(options.settings.width, 1280u);
    EXPECT_EQ(options.settings.height, 720u);
    EXPECT_EQ(options.settings.spp, 16u);
    EXPECT_EQ(options.settings.seed, 0u);
    EXPECT_EQ(options.settings.shadow_res, 1024u);
    EXPECT_EQ(options.settings.method, "exact");
    EXPECT_EQ(options.settings.memory_budget, 0u);
    EXPECT_TRUE(options.settings.closed_meshes);
    EXPECT_TRUE(options.settings.static_once);
    EXPECT_EQ(options.shutter.open, 0.0);
    EXPECT_EQ(options.shutter.close, 0.0208333);
    EXPECT_EQ(options.fps, 24.0);
    EXPECT_EQ(options.shutter_angle, 180.0);
    EXPECT_EQ(options.animation, "0");
    EXPECT_EQ(options.time_steps, 1u);
    EXPECT_EQ(options.exposure, 0.0);
    EXPECT_FALSE(options.ground || options.frames || options.validate);
}

TEST(RenderOptions, EveryOptionArrives) {
    const RenderOptions options = parse({"a.glb",
                                         "-o",
                                         "a.exr",
                                         "--png=a.png",
                                         "--json",
                                         "-",
                                         "--size=64x48",
                                         "--spp",
                                         "2",
                                         "--seed=3",
                                         "--shutter",
                                         "-1:2",
                                         "--animation",
                                         "all",
                                         "--camera=main",
                                         "--time-steps=4",
                                         "--method=dtr",
                                         "--layout",
                                         "list",
                                         "--raster=prism",
                                         "--pages=asked",
                                         "--shadow-res=512",
                                         "--memory-budget=1M",
                                         "--device=1",
                                         "--exposure",
                                         "-1",
                                         "--ground",
                                         "-2",
                                         "--no-closed-meshes",
                                         "--no-static-once",
                                         "--validate"});
    EXPECT_EQ(options.exr, "a.exr");
    EXPECT_EQ(options.png, "a.png");
    EXPECT_EQ(options.json, "-");
    EXPECT_EQ(options.settings.width, 64u);
    EXPECT_EQ(options.settings.height, 48u);
    EXPECT_EQ(options.settings.spp, 2u);
    EXPECT_EQ(options.settings.seed, 3u);
    EXPECT_EQ(options.shutter.open, -1.0);
    EXPECT_EQ(options.shutter.close, 2.0);
    EXPECT_EQ(options.animation, "all");
    EXPECT_EQ(options.camera, "main");
    EXPECT_EQ(options.time_steps, 4u);
    EXPECT_EQ(options.settings.method, "dtr");
    EXPECT_EQ(options.settings.layout, "list");
    EXPECT_EQ(options.settings.raster, "prism");
    EXPECT_EQ(options.settings.pages, "asked");
    EXPECT_EQ(options.settings.shadow_res, 512u);
    EXPECT_EQ(options.settings.memory_budget, 1048576u);
    EXPECT_EQ(options.device, "1");
    EXPECT_EQ(options.exposure, -1.0);
    ASSERT_TRUE(options.ground);
    EXPECT_EQ(options.ground->height, -2.0f);
    EXPECT_TRUE(options.validate);
    EXPECT_FALSE(options.settings.closed_meshes);
    EXPECT_FALSE(options.settings.static_once);
}

TEST(RenderOptions, StillIsOneFrame) {
    const auto frames = cli::frame_jobs(parse({"a.glb", "-o", "a#.exr", "--shutter=1:2"}));
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].number, std::nullopt);
    EXPECT_EQ(frames[0].exr, "a#.exr");
    EXPECT_EQ(frames[0].shutter.open, 1.0);
    EXPECT_EQ(frames[0].shutter.close, 2.0);
    EXPECT_EQ(frames[0].png, std::nullopt);
    EXPECT_EQ(frames[0].json, "");
}

TEST(RenderOptions, SequenceOpensAtNOverFAndStaysOpenForTheAngle) {
    const auto frames = cli::frame_jobs(parse({"a.glb", "-o", "a_####.exr", "--png", "a_##.png", "--json", "####.json",
                                               "--frames=9-10", "--fps=10", "--shutter-angle=90"}));
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].number, 9u);
    EXPECT_DOUBLE_EQ(frames[0].shutter.open, 0.9);
    EXPECT_DOUBLE_EQ(frames[0].shutter.close, 0.925);
    EXPECT_EQ(frames[0].exr, "a_0009.exr");
    EXPECT_EQ(frames[1].shutter.open, 1.0);
    EXPECT_EQ(frames[1].exr, "a_0010.exr");
    EXPECT_EQ(frames[1].png, "a_10.png");
    EXPECT_EQ(frames[1].json, "0010.json");
}

TEST(RenderOptions, NamesAreChecked) {
    EXPECT_GNOMON_ERROR(cli::frame_jobs(parse({"a.glb", "-o", "a.png"})), ErrorKind::usage, ".exr, -o; ");
    EXPECT_GNOMON_ERROR(cli::frame_jobs(parse({"a.glb", "-o", "a.exr", "--png=a.jpg"})), ErrorKind::usage, ".png, --png; ");
    EXPECT_GNOMON_ERROR(cli::frame_jobs(parse({"a.glb", "-o", "a.exr", "--json=a.exr"})), ErrorKind::usage, ".json, --json; ");
    EXPECT_GNOMON_ERROR(cli::frame_jobs(parse({"a.glb", "-o", "a.exr", "--frames=0-1"})), ErrorKind::usage, "####");
    EXPECT_GNOMON_ERROR(cli::frame_jobs(parse({"a.glb", "-o", "#.exr", "--png=a.png", "--frames=0-1"})), ErrorKind::usage,
                        "--png");
    EXPECT_GNOMON_ERROR(cli::frame_jobs(parse({"a.glb", "-o", "#.exr", "--json=a.json", "--frames=0-1"})), ErrorKind::usage,
                        "--json");
}

TEST(RenderOptions, SettingsNameWhatThePictureDependsOn) {
    const RenderOptions options =
        parse({"folder/a.glb", "-o", "#.exr", "--png=#.png", "--frames=3-3", "--ground=auto", "--exposure=2"});
    DeviceDescription device;
    device.name = "gpu";
    device.driver = "maker 1.2";
    const io::Json settings = cli::frame_settings(options, options.settings, cli::frame_jobs(options)[0], "main", device);
    EXPECT_EQ(settings["scene"], "a.glb");
    EXPECT_EQ(settings["camera_name"], "main");
    EXPECT_EQ(settings["device"], "gpu");
    EXPECT_EQ(settings["driver"], "maker 1.2");
    EXPECT_EQ(settings["spp"], 16);
    EXPECT_EQ(settings["animation"], "0");
    EXPECT_EQ(settings["time_steps"], 1);
    EXPECT_EQ(settings["shutter_open"], 0.125);
    EXPECT_EQ(settings["shutter_close"], 3.5 / 24.0);
    EXPECT_EQ(settings["frame"], 3);
    EXPECT_EQ(settings["fps"], 24.0);
    EXPECT_EQ(settings["shutter_angle"], 180.0);
    EXPECT_EQ(settings["ground"], "auto");
    EXPECT_EQ(settings["exposure"], 2.0);
}

}  // namespace gnomon::test
