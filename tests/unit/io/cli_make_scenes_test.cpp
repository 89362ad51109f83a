// SPDX-License-Identifier: Apache-2.0
// The command make_scenes: its options reach the makers, mistakes are errors, Ctrl-C ends it.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <scenes/scene_makers.hpp>
#include <thread>

#include "command_runner.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class MakeScenesTest : public TestFolder {
protected:
    CommandResult run(const std::vector<std::string>& arguments, const std::function<void(int)>& while_running = {}) {
        return run_command(GN_PATH(GNOMON_MAKE_SCENES), folder, arguments, {}, while_running);
    }
    /// The scene as the command makes it.
    std::string made(const std::vector<std::string>& arguments) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.out + result.err, "");
        return content_of(folder / "a.glb");
    }
    std::filesystem::path expected() const { return folder / "expected.glb"; }
};

TEST_F(MakeScenesTest, OptionsReachTheMakers) {
    makers::make_random_cubes(
        expected(),
        {.count = 5, .seed = 7, .size = 0.5, .speed_min = 1.5, .speed_max = 2.0, .height = 30.0, .ground = 3.0, .times = 2.0});
    EXPECT_EQ(made({"random-cubes", "-o", "a.glb", "--count=5", "--seed", "7", "--size", "0.5", "--speed", "1.5:2", "--height",
                    "30", "--ground", "3", "--times=2"}),
              content_of(expected()));
    makers::make_tree(expected(), {.leaves = 300, .seed = 3, .sway = 0.1, .fill_light = true});
    EXPECT_EQ(made({"tree", "--leaves", "300", "--seed=3", "--sway=0.1", "--fill-light", "yes", "-o", "a.glb"}),
              content_of(expected()));
    makers::make_chess(expected(), {.triangles = 10000, .moving = 2});
    EXPECT_EQ(made({"chess", "--triangles", "10000", "--moving", "2", "-oa.glb"}), content_of(expected()));
    makers::make_figure(expected(), {.triangles = 2000, .fill_light = false});
    EXPECT_EQ(made({"figure", "--triangles", "2000", "--fill-light=no", "-oa.glb"}), content_of(expected()));
    makers::make_pillars(expected(), {.columns = 2, .rising = true});
    EXPECT_EQ(made({"pillars", "--columns=2", "--rising=yes", "-oa.glb"}), content_of(expected()));
    makers::make_crossing_quads(expected());
    EXPECT_EQ(made({"crossing-quads", "--output=a.glb"}), content_of(expected()));
}

TEST_F(MakeScenesTest, HelpNamesEveryScene) {
    const CommandResult help = run({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* name :
         {"all", "figure", "character", "runner", "wrecking-ball", "tree", "octopus", "chess", "two-cubes", "random-cubes",
          "pillars", "crossing-quads", "receding-quads", "tube", "stadium", "--speed", "4:8"})
        EXPECT_THAT(help.out, HasSubstr(name));
}

TEST_F(MakeScenesTest, MistakesAreOneLineThatATerminalMayShow) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{},
                                               {"\x1b[31mno\nscene", "-o", "a.glb"},
                                               {"pillars"},
                                               {"pillars", "-o", ""},
                                               {"pillars", "-o", "a.glb", "\x1b[31m--no\noption"},
                                               {"pillars", "-o", "a.glb", "--columns", "\x1b[31mtwo\n"},
                                               {"pillars", "-o", "a.glb", "--columns", "-1"},
                                               {"pillars", "-o", "a.glb", "--columns", "101"},
                                               {"pillars", "-o", "a.glb", "--rising", "perhaps"},
                                               {"pillars", "-o", "a\n.txt"},
                                               {"random-cubes", "-o", "a.glb", "--speed", "4"},
                                               {"random-cubes", "-o", "a.glb", "--speed", "4:x"}}) {
        SCOPED_TRACE(testing::PrintToString(arguments));
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.err, AllOf(StartsWith("make_scenes: error: "), EndsWith("\n"), Not(HasSubstr("\x1b"))));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(names(), std::set<std::string>{});
    }
    const CommandResult no_folder = run({"pillars", "-o", "no/\x1b/a.gltf"});
    EXPECT_EQ(no_folder.exit_code, 3);
    EXPECT_THAT(no_folder.err, HasSubstr("no/\\x1b/a.bin"));
}

TEST_F(MakeScenesTest, AnInterruptWhileItWritesEndsItWithoutATemporaryFile) {
    const auto is_temporary = [](const std::string& name) { return name.starts_with(".gnomon-"); };
    const auto writes = [&] {
        const std::set<std::string> found = names();
        return std::any_of(found.begin(), found.end(), is_temporary);
    };
    const CommandResult result = run({"octopus", "--triangles=4000000", "-o", "a.gltf"}, [&](int child) {
        for (int i = 0; i < 60000 && !writes(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kill(child, SIGINT);
    });
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "make_scenes: error: interrupted; run it again\n");
    EXPECT_FALSE(writes());
}

}  // namespace
}  // namespace gnomon::test
