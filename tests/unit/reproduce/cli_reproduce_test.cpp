// SPDX-License-Identifier: Apache-2.0
// `gnomon reproduce` as its users see it. What renders needs a Vulkan device; without one it says that it is skipped.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "command_runner.hpp"
#include "test_folder.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Names = std::set<std::string>;

class CliReproduceTest : public TestFolder {
protected:
    CommandResult reproduce(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "reproduce");
        return run_gnomon(folder, arguments);
    }
};

TEST_F(CliReproduceTest, ListsFiguresWithTheirMethods) {
    const CommandResult result = reproduce({"--list"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("2015-13 "));
    EXPECT_THAT(result.out, HasSubstr("tsm, "));
}

TEST_F(CliReproduceTest, BadArgumentsAreUsage) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"2015-13"},
                                                      {"-o", "out"},
                                                      {"2016-1", "-o", "out"},
                                                      {"2015-13", "-o", "out", "--scale", "0"},
                                                      {"2015-13", "-o", "out", "--repeat", "x"}}) {
        const CommandResult result = reproduce(arguments);
        EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments);
        EXPECT_THAT(result.err, HasSubstr("gnomon: error: "));
    }
    EXPECT_EQ(names(), Names{});
}

TEST_F(CliReproduceTest, FolderThatCannotBeMade) {
    put_content(folder / "file", "");
    EXPECT_EQ(reproduce({"2015-13", "-o", "file/out"}).exit_code, 3);
    EXPECT_EQ(names(), Names{"file"});
}

TEST_F(CliReproduceTest, SmallestFigures) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const CommandResult result =
        reproduce({"2015-13", "2015-12", "-o", "out", "--scale=0.04", "--repeat=3", "--reference-spp=8", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, HasSubstr("2015-13: out/2015-13.html"));
    for (const char* name : {"2015-13.html", "2015-13.json", "2015-12.html", "2015-12.json", "index.html"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;

    const json figure = json::parse(content_of(folder / "out" / "2015-13.json"));
    EXPECT_EQ(figure["schema"], "gnomon.reproduce");
    EXPECT_EQ(figure["scale"], 0.04);
    ASSERT_EQ(figure["settings"].size(), 1u);
    EXPECT_EQ(figure["settings"][0]["width"], 51);
    for (const json& run : figure["settings"][0]["runs"]) {
        SCOPED_TRACE(run["label"]);
        double seconds = 0.0;
        for (const json& stage : run["stages"]) seconds += stage["seconds"]["value"].get<double>();
        EXPECT_NEAR(run["metrics"]["seconds"]["value"].get<double>(), seconds, 1e-6);
        for (const char* metric : {"false_shadow", "error", "noise", "flip", "map_seconds", "map_bytes"})
            EXPECT_TRUE(run["metrics"].contains(metric)) << metric;
        EXPECT_GT(run["metrics"]["map_seconds"]["value"], 0.0);
        EXPECT_LT(run["metrics"]["map_seconds"]["value"], run["metrics"]["seconds"]["value"]);
        if (run["method"] == "exact") {
            EXPECT_LT(run["metrics"]["false_shadow"]["value"], 1e-3);
        }
        if (run["method"] == "tsm") {
            EXPECT_GT(run["metrics"]["false_shadow"]["value"], 1e-3);
        }
    }
    ASSERT_FALSE(figure["claims"].empty());
    EXPECT_FALSE(figure["claims"][0]["checks"].empty());

    const std::string page = content_of(folder / "out" / "2015-13.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    for (const char* outside : {"http://", "https://", "src=\"/", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << "a page needs nothing else: " << outside;
    EXPECT_THAT(content_of(folder / "out" / "index.html"), HasSubstr("href=\"2015-12.html\""));
}

TEST_F(CliReproduceTest, InterruptExitsWith130AndLeavesNoHalfFile) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const auto interrupt = [](int child) {
        std::this_thread::sleep_for(std::chrono::seconds(2));
        kill(child, SIGINT);
    };
    const CommandResult result =
        run_gnomon(folder, {"reproduce", "2018-11", "-o", "out", "--scale=0.1", "--repeat=1000", "--quiet"}, {}, interrupt);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
}

}  // namespace
}  // namespace gnomon::test
