// SPDX-License-Identifier: Apache-2.0
// The command as its users see it: help, usage errors, info, devices.
#include <fcntl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <gnomon/version.hpp>
#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "test_folder.hpp"
#include "tiny_scene.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class CliTest : public TestFolder {
protected:
    CommandResult run(const std::vector<std::string>& arguments) { return run_gnomon(folder, arguments); }
};

/// One line: `gnomon: error: what, where; what to do`.
MATCHER(IsOneError, "") {
    return ::testing::ExplainMatchResult(MatchesRegex("gnomon: error: [^\n]+, [^\n]+; [^\n]+\n"), arg, result_listener);
}

TEST_F(CliTest, Version) {
    const CommandResult result = run({"--version"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.out, "gnomon " GNOMON_VERSION "\n");
    EXPECT_EQ(result.err, "");
}

TEST_F(CliTest, HelpGoesToStdout) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"--help"},
                                                                                           {"render", "--help"},
                                                                                           {"info", "--help"},
                                                                                           {"devices", "--help"},
                                                                                           {"doctor", "--help"},
                                                                                           {"methods", "--help"},
                                                                                           {"compare", "--help"},
                                                                                           {"ranges", "--help"}}) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << arguments[0];
        EXPECT_THAT(result.out, HasSubstr("Usage: gnomon")) << arguments[0];
        EXPECT_EQ(result.err, "") << arguments[0];
    }
    const std::string help = run({"render", "--help"}).out;
    for (const char* option :
         {"-o",        "--png",    "--exposure",      "--size",          "--spp",    "--seed",       "--shutter",
          "--frames",  "--fps",    "--shutter-angle", "--animation",     "--camera", "--time-steps", "--method",
          "--layout",  "--raster", "--shadow-res",    "--memory-budget", "--device", "--json",       "--quiet",
          "--verbose", "--ground", "--validate",      "--map-spp",       "--bias",   "--pages"})
        EXPECT_THAT(help, HasSubstr(option));
}

TEST_F(CliTest, UsageErrorsAreOneLineAndExitWith2) {
    put_content(folder / "a.gltf", tiny_scene());
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {"bogus"},
                                               {"render"},
                                               {"render", "a.gltf"},
                                               {"render", "a.gltf", "-o"},
                                               {"render", "a.gltf", "-o", "a.exr", "--bogus"},
                                               {"render", "a.gltf", "-o", "a.exr", "--spp", "none"},
                                               {"render", "a.gltf", "-o", "a.exr", "--size=0x1"},
                                               {"render", "a.gltf", "-o", "a.exr", "--shutter=1:0"},
                                               {"render", "a.gltf", "-o", "a.exr", "--raster=magic"},
                                               {"render", "a.gltf", "-o", "a.exr", "--pages=some"},
                                               {"render", "a.gltf", "-o", "a.exr", "--method=tsm", "--layout=array"},
                                               {"render", "a.gltf", "-o", "a.exr", "--method=tsm", "--bias=-1"},
                                               {"render", "a.gltf", "-o", "a.exr", "--quiet", "--verbose"},
                                               {"render", "a.gltf", "-o", "a.exr", "--camera=none"},
                                               {"render", "a.gltf", "-o", "a.exr", "--animation=none_of_these"},
                                               {"render", "a.gltf", "-o", "a.png"},
                                               {"render", "a.gltf", "-o", "a.exr", "--frames", "0-1"},
                                               {"render", "a.gltf", "-o", "####.exr", "--frames", "0-1", "--shutter", "0:1"},
                                               {"render", "a.gltf", "-o", ""},
                                               {"render", "a.gltf", "-o", "a.exr", "--png", ""},
                                               {"render", "a.gltf", "-o", "a.exr", "--json", ""},
                                               {"render", "a.gltf", "-o", "a.exr", "--camera", ""},
                                               {"render", "a.gltf", "-o", "a.exr", "--device", ""},
                                               {"render", "a.gltf", "-o", "a.exr", "--animation", ""},
                                               {"render", "a.gltf", "-o", "####.exr", "--frames", "0-4294967295"},
                                               {"info", "a.gltf", "--json", ""},
                                               {"devices", "--json", ""},
                                               {"compare", "a.exr", "b.exr", "--diff", ""},
                                               {"compare", "a.exr", "b.exr", "--again", ""},
                                               {"compare", "a.exr", "b.exr", "--channels", ""},
                                               {"compare", "a.exr"},
                                               {"compare", "a.exr", "b.exr", "--metric=vmaf"},
                                               {"compare", "a.exr", "b.exr", "--threshold=-1"},
                                               {"compare", "a.exr", "b.exr", "--diff=d.png"}}) {
        const CommandResult result = run(arguments);
        SCOPED_TRACE(::testing::PrintToString(arguments));
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_EQ(result.out, "");
        EXPECT_THAT(result.err, IsOneError());
    }
    EXPECT_THAT(run({"bogus"}).err, HasSubstr("bogus"));
    EXPECT_THAT(run({"render", "--bogus"}).err, HasSubstr("gnomon render --help"));
    EXPECT_THAT(run({"render", "a.gltf", "-o", "a.exr", "--width", "640"}).err, HasSubstr("not expected: --width 640,"));
    EXPECT_EQ(names(), std::set<std::string>{"a.gltf"});
}

TEST_F(CliTest, OutputsAreCheckedBeforeAnythingElse) {
    for (const char* option : {"-o", "--png", "--json"}) {
        std::vector<std::string> arguments = {"render", "missing.glb", "-o", "a.exr"};
        const std::string ending = option == std::string("-o") ? ".exr" : "." + std::string(option + 2);
        if (option == std::string("-o")) {
            arguments[3] = "none/a.exr";
        } else {
            arguments.insert(arguments.end(), {option, "none/a" + ending});
        }
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 3) << option;
        EXPECT_THAT(result.err, AllOf(IsOneError(), HasSubstr("none/a" + ending + "; create the folder"))) << option;
    }
}

TEST_F(CliTest, MissingSceneExitsWith3) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", "none.glb"}, {"render", "none.glb", "-o", "a.exr"}}) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 3);
        EXPECT_EQ(result.out, "");
        EXPECT_THAT(result.err, AllOf(IsOneError(), HasSubstr("none.glb")));
    }
    EXPECT_EQ(names(), std::set<std::string>{});
}

TEST_F(CliTest, ErrorsStayOnOneLineWhateverTheFileIsCalled) { EXPECT_THAT(run({"info", "two\nlines.glb"}).err, IsOneError()); }

/// Lines of printable ASCII.
MATCHER(IsPlainText, "") {
    return std::all_of(arg.begin(), arg.end(), [](unsigned char c) { return c == '\n' || (c >= ' ' && c < 0x7f); });
}

TEST_F(CliTest, WhatNamesHoldDoesNotReachTheTerminal) {
    const std::string name =
        "\x1b[2J\x1b]0;title\x07two\nlines\xc2\x9b"
        "1m";
    json scene = json::parse(tiny_scene());
    scene["nodes"][0].update({{"name", name}, {"camera", 0}});
    scene["cameras"] = {{{"name", name}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    scene["materials"] = {{{"name", name}, {"alphaMode", "BLEND"}}};
    scene["extensionsUsed"] = {"EXT_" + name};
    put_content(folder / "a.gltf", scene.dump());
    const CommandResult text = run({"info", "a.gltf"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, AllOf(IsPlainText(), HasSubstr("'\\x1b[2J\\x1b]0;title\\x07two\\nlines\\xc2\\x9b1m'")));
    EXPECT_EQ(json::parse(run({"info", "a.gltf", "--json=-"}).out)["cameras"][0]["name"], name);
    const CommandResult render = run({"render", "a.gltf", "-o", "a.exr", "--camera", "none"});
    EXPECT_EQ(render.exit_code, 2);
    EXPECT_THAT(render.err, AllOf(IsPlainText(), HasSubstr("alpha blending is ignored"), HasSubstr("\\x1b[2J")));
    EXPECT_THAT(run({"info", name + ".glb"}).err, AllOf(IsPlainText(), IsOneError()));
    EXPECT_THAT(run({name}).err, AllOf(IsPlainText(), IsOneError()));
}

TEST_F(CliTest, InfoAsJson) {
    put_content(folder / "a.gltf", tiny_scene());
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", "a.gltf", "--json", "-"}, {"info", "a.gltf", "--json=-"}}) {
        const CommandResult result = run(arguments);
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const json info = json::parse(result.out);
        EXPECT_EQ(info["schema"], "gnomon.info");
        EXPECT_EQ(info["schema_version"], 1);
        EXPECT_EQ(info["triangles"], 1);
        EXPECT_EQ(info["vertices"], 3);
        EXPECT_EQ(info["nodes"], 1);
        EXPECT_EQ(info["meshes"], 1);
        EXPECT_EQ(info["bounds"]["lower"], json({0.0, 0.0, 0.0}));
        EXPECT_EQ(info["bounds"]["upper"], json({1.0, 1.0, 0.0}));
        EXPECT_EQ(info["cameras"], json::array());
        EXPECT_EQ(info["lights"], json::array());
    }
}

TEST_F(CliTest, InfoAsTextAndJsonFile) {
    put_content(folder / "a.gltf", tiny_scene());
    const CommandResult result = run({"info", "a.gltf", "--json", "a.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("triangles        1\n"));
    EXPECT_EQ(json::parse(content_of(folder / "a.json"))["triangles"], 1);
}

TEST_F(CliTest, ResultsThatCannotBeWrittenAreAnError) {
    put_content(folder / "a.gltf", tiny_scene());
    const CommandResult result =
        run_gnomon(folder, {"info", "a.gltf"}, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, AllOf(IsOneError(), HasSubstr("standard output")));
}

TEST_F(CliTest, Methods) {
    const CommandResult result = run({"methods", "--json=-"});
    EXPECT_EQ(result.exit_code, 0);
    const json document = json::parse(result.out);
    EXPECT_EQ(document["schema"], "gnomon.methods");
    const std::string help = run({"render", "--help"}).out, text = run({"methods"}).out;
    for (const json& method : document["methods"]) {
        EXPECT_THAT(text, HasSubstr(method["name"].get<std::string>()));
        for (const json& parameter : method["parameters"]) {
            EXPECT_THAT(help, HasSubstr("--" + parameter["name"].get<std::string>()));
            EXPECT_LT(parameter["least"].get<double>(), parameter["most"].get<double>());
        }
    }
}

TEST_F(CliTest, Devices) {
    const CommandResult result = run({"devices", "--json=-"});
    const json document = json::parse(result.out);
    EXPECT_EQ(document["schema"], "gnomon.devices");
    bool usable = false;
    int chosen = 0;
    for (const json& device : document["devices"]) {
        EXPECT_EQ(device["usable"], device["missing"].empty());
        usable = usable || device["usable"].get<bool>();
        chosen += device["chosen"].get<bool>() ? 1 : 0;
    }
    EXPECT_EQ(chosen, usable ? 1 : 0);
    EXPECT_EQ(result.exit_code, usable ? 0 : 4);
    EXPECT_EQ(result.err.find("no usable Vulkan device") != std::string::npos, !usable);
}

TEST_F(CliTest, RangesOfALightsView) {
    put_content(folder / "a.gltf", tiny_scene());
    const CommandResult text = run({"ranges", "a.gltf", "--shadow-res", "32"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, AllOf(HasSubstr("triangles in texels"), HasSubstr("prism's linear depth")));
    const json document = json::parse(run({"ranges", "a.gltf", "--shadow-res", "32", "--json", "-"}).out);
    EXPECT_GT(document.at("pairs").get<uint64_t>(), 10u);
    EXPECT_EQ(document.at("missed"), 0);
    const CommandResult wrong = run({"ranges", "a.gltf", "--light", "7"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("there is no light 7"));
}

}  // namespace gnomon::test
