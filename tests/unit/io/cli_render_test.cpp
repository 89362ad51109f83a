// SPDX-License-Identifier: Apache-2.0
// `gnomon render` as its users see it. Needs a Vulkan device; without one these tests say that they are skipped.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "command_runner.hpp"
#include "io/exr.hpp"
#include "test_folder.hpp"
#include "tiny_scene.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using Names = std::set<std::string>;

class CliRenderTest : public TestFolder {
protected:
    void SetUp() override {
        GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
        put_content(folder / "a.gltf", tiny_scene());
    }

    /// Render the tiny scene, small.
    CommandResult render(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"render", "a.gltf", "--size=32x24", "--spp=4"});
        return run_gnomon(folder, arguments);
    }
};

TEST_F(CliRenderTest, FrameWithAllOutputs) {
    const CommandResult result = render({"-o", "a.exr", "--png", "a.png", "--json", "a.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, Not(HasSubstr("\r")));  // No bar where there is no terminal.
    EXPECT_EQ(names(), (Names{"a.exr", "a.gltf", "a.json", "a.png"}));

    const io::ExrImage image = io::read_exr(folder / "a.exr");
    EXPECT_EQ(image.width, 32u);
    EXPECT_EQ(image.height, 24u);
    for (const char* channel : {"R", "G", "B", "A", "Z", "visibility.0", "visibility_var.0"})
        EXPECT_NE(image.find(channel), nullptr) << channel;
    EXPECT_EQ(image.attributes.at("gnomon:spp"), "4");
    EXPECT_EQ(image.attributes.at("gnomon:scene"), "a.gltf");
    EXPECT_EQ(image.attributes.at("gnomon:shutter_close"), "0.0208333");

    const json document = json::parse(content_of(folder / "a.json"));
    EXPECT_EQ(document["schema"], "gnomon.render");
    EXPECT_EQ(document["settings"]["width"], 32);
    EXPECT_EQ(document["outputs"], json({"a.exr", "a.png"}));
    EXPECT_FALSE(document["stages"].empty());
    EXPECT_TRUE(document["counts"].contains("shadow_tests"));
    for (const char* not_counted : {"camera_tests", "ranges_visited", "ranges_tested"})
        EXPECT_FALSE(document["counts"].contains(not_counted)) << not_counted;
    EXPECT_EQ(document["device"], image.attributes.at("gnomon:device"));
    EXPECT_EQ(document["driver"], image.attributes.at("gnomon:driver"));
    EXPECT_THAT(run_gnomon(folder, {"devices"}).out, HasSubstr(document["driver"].get<std::string>()));
}

TEST_F(CliRenderTest, SaysWhatItAdded) {
    const CommandResult result = render({"-o", "a.exr", "--ground", "auto"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("camera"));
    EXPECT_THAT(result.err, HasSubstr("light"));
    EXPECT_EQ(render({"-o", "a.exr", "--quiet"}).err, "");
}

TEST_F(CliRenderTest, GroundFillsMoreOfThePicture) {
    ASSERT_EQ(render({"-o", "bare.exr"}).exit_code, 0);
    ASSERT_EQ(render({"-o", "ground.exr", "--ground", "-1"}).exit_code, 0);
    const auto coverage = [&](const char* name) {
        double sum = 0.0;
        const io::ExrImage image = io::read_exr(folder / name);
        for (const float alpha : image.find("A")->values) sum += alpha;
        return sum;
    };
    EXPECT_GT(coverage("bare.exr"), 0.0);
    EXPECT_GT(coverage("ground.exr"), coverage("bare.exr"));
}

TEST_F(CliRenderTest, JsonOnStdoutIsNothingElse) {
    const CommandResult result = render({"-o", "a.exr", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["schema"], "gnomon.render");
}

TEST_F(CliRenderTest, SameArgumentsGiveTheSameBytes) {
    ASSERT_EQ(render({"-o", "a.exr"}).exit_code, 0);
    ASSERT_EQ(render({"-o", "b.exr"}).exit_code, 0);
    EXPECT_EQ(content_of(folder / "a.exr"), content_of(folder / "b.exr"));
}

TEST_F(CliRenderTest, Sequence) {
    const CommandResult result = render({"-o", "f_####.exr", "--png=f_####.png", "--json=-", "--frames=9-10", "--fps=10"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(names(), (Names{"a.gltf", "f_0009.exr", "f_0009.png", "f_0010.exr", "f_0010.png"}));
    EXPECT_EQ(io::read_exr(folder / "f_0010.exr").attributes.at("gnomon:shutter_open"), "1.0");
    const size_t line_end = result.out.find('\n');
    EXPECT_EQ(json::parse(result.out.substr(0, line_end))["settings"]["frame"], 9);
    EXPECT_EQ(json::parse(result.out.substr(line_end))["settings"]["frame"], 10);
}

TEST_F(CliRenderTest, UnusedOptionsAreNamed) {
    const CommandResult result = render({"-o", "a.exr", "--fps=10", "--exposure=1"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("gnomon: warning: --fps has no effect without --frames\n"));
    EXPECT_THAT(result.err, HasSubstr("gnomon: warning: --exposure has no effect without --png\n"));
}

// Each sample has light that a float holds; their sum is more.
TEST_F(CliRenderTest, PicturesThatAreNotFiniteAreNotWritten) {
    json scene = json::parse(tiny_scene());
    scene["extensionsUsed"] = {"KHR_lights_punctual"};
    scene["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 3e38}}};
    scene["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    put_content(folder / "a.gltf", scene.dump());
    const CommandResult result = render({"-o", "a.exr"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("values of the picture are more than 32-bit floats can hold, a.gltf; lower"));
    EXPECT_EQ(names(), Names{"a.gltf"});
}

TEST_F(CliRenderTest, FullDiskLeavesNothing) {
    const CommandResult result =
        run_gnomon(folder, {"render", "a.gltf", "-o", "a.exr", "--size=256x256", "--spp=1", "--quiet"}, [] {
            const rlimit limit{1024, 1024};
            setrlimit(RLIMIT_FSIZE, &limit);
        });
    // lavapipe of Mesa 25 has its device memory in files without a name.
    if (result.exit_code == 128 + SIGBUS) GTEST_SKIP() << "skipped: the limit stops the driver before it stops the picture";
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(names(), Names{"a.gltf"});
}

TEST_F(CliRenderTest, InterruptExitsWith130AndLeavesNothing) {
    const auto interrupt = [](int child) {
        std::this_thread::sleep_for(std::chrono::seconds(2));
        kill(child, SIGINT);
    };
    const CommandResult result = run_gnomon(
        folder, {"render", "a.gltf", "-o", "a.exr", "--size=2048x2048", "--spp=4096", "--ground=auto"}, {}, interrupt);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted"));
    EXPECT_EQ(names(), Names{"a.gltf"});
}

}  // namespace gnomon::test
