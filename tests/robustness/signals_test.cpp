// SPDX-License-Identifier: Apache-2.0
// The command is interrupted and killed at random times.
#include <gmock/gmock.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "io/exr.hpp"
#include "support/paths.hpp"
#include "trials.hpp"
#include "unit/io/tiny_scene.hpp"

namespace gnomon::test {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Names = std::set<std::string>;

/// Of a process that runs.
double cpu_seconds(int process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 1));  // Its name may be anything.
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Of all processes that have ended.
double ended_cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Work {
    const char* name;
    std::vector<std::string> arguments;  ///< Of something that takes longer than `longest`.
    double longest;                      ///< Seconds after which it is interrupted, at most.
};

std::ostream& operator<<(std::ostream& stream, const Work& work) { return stream << work.name; }

class Interrupts : public RobustnessTest, public testing::WithParamInterface<Work> {};

TEST_P(Interrupts, EndWithinHalfASecond) {
    constexpr double kLongest = 0.5, kLongestWait = 30.0;
    std::mt19937 random(1);
    std::vector<double> delays;
    for (size_t i = 0; i < trials(3); ++i) {
        Clock::time_point interrupted;
        double cpu = -ended_cpu_seconds();
        const auto interrupt = [&](int child) {
            std::this_thread::sleep_for(Seconds(std::uniform_real_distribution(0.05, GetParam().longest)(random)));
            interrupted = Clock::now();
            cpu -= cpu_seconds(child);
            kill(child, SIGINT);
        };
        std::vector<std::string> arguments = GetParam().arguments;
        std::replace(arguments.begin(), arguments.end(), std::string("SCENE"),
                     GN_PATH(GNOMON_SOURCE_DIR) + "/scenes/random-cubes.gltf");
        const CommandResult result = run_gnomon(folder, arguments, {}, interrupt);
        const double waited = Seconds(Clock::now() - interrupted).count();
        cpu += ended_cpu_seconds();
        // On a machine that is busy with something else it ends later, but does no more until then.
        delays.push_back(std::min(waited, cpu));
        EXPECT_LT(waited, kLongestWait);
        EXPECT_EQ(result.exit_code, 130) << result.err;
        EXPECT_THAT(result.err, testing::EndsWith("gnomon: error: interrupted; run it again\n"));
        EXPECT_EQ(names(), Names{});
    }
    std::sort(delays.begin(), delays.end());
    const double median = delays[delays.size() / 2];
    std::printf("%s: %zu times, median %.3f s, 90 %% %.3f s, longest %.3f s\n", GetParam().name, delays.size(), median,
                delays[delays.size() * 9 / 10], delays.back());
    EXPECT_LT(median, kLongest);
}

INSTANTIATE_TEST_SUITE_P(
    Stages, Interrupts,
    testing::Values(Work{"lists", {"render", "SCENE", "-oa.exr", "--time-steps=16", "--shadow-res=8192", "--pages=all"}, 2.0},
                    Work{"dsm", {"render", "SCENE", "-oa.exr", "--method=dsm", "--shadow-res=4096", "--spp=256"}, 2.0},
                    Work{"fssm", {"render", "SCENE", "-oa.exr", "--method=fssm", "--shadow-res=4096", "--spp=256"}, 2.0},
                    Work{"dtr", {"render", "SCENE", "-oa.exr", "--method=dtr", "--shadow-res=4096"}, 2.0},
                    Work{"samples", {"render", "SCENE", "-oa.exr", "--size=4096x4096", "--spp=1024"}, 2.0}),
    [](const auto& work) { return work.param.name; });

class Kills : public RobustnessTest {
protected:
    void SetUp() override {
        RobustnessTest::SetUp();
        put_content(folder / "a.gltf", tiny_scene());
    }

    size_t temporaries() const {
        const Names found = names();
        return static_cast<size_t>(
            std::count_if(found.begin(), found.end(), [](const std::string& name) { return name.starts_with(".gnomon-"); }));
    }

    void check_whole() const {
        if (std::filesystem::exists(folder / "a.exr")) {
            EXPECT_EQ(io::read_exr(folder / "a.exr").width, 512u);
        }
        if (std::filesystem::exists(folder / "a.png")) {
            const std::string png = content_of(folder / "a.png");
            EXPECT_TRUE(png.starts_with("\x89PNG") && png.substr(png.size() - 8, 4) == "IEND");
        }
        if (std::filesystem::exists(folder / "a.json")) {
            EXPECT_EQ(nlohmann::json::parse(content_of(folder / "a.json"))["schema"], "gnomon.render");
        }
    }

    const std::vector<std::string> render = {"render",  "a.gltf",  "-oa.exr",        "--png=a.png",     "--json=a.json",
                                             "--spp=1", "--quiet", "--size=512x512", "--shadow-res=64", "--ground=auto"};
};

TEST_F(Kills, LeaveWholeFilesOrNoneAndNothingThatTheNextRunDoesNotClear) {
    const Clock::time_point start = Clock::now();
    ASSERT_EQ(run_gnomon(folder, render).exit_code, 0);
    const double whole_run = Seconds(Clock::now() - start).count();
    std::mt19937 random(1);
    size_t killed = 0, with_temporaries = 0, without_files = 0;
    const size_t wanted = trials(5);
    for (size_t i = 0; i < 10 * wanted && killed < wanted; ++i) {
        for (const char* name : {"a.exr", "a.png", "a.json"}) std::filesystem::remove(folder / name);
        const CommandResult result = run_gnomon(folder, render, {}, [&](int child) {
            std::this_thread::sleep_for(Seconds(std::uniform_real_distribution(0.0, whole_run)(random)));
            kill(child, SIGKILL);
        });
        killed += result.exit_code == 128 + SIGKILL;
        with_temporaries += temporaries() > 0;
        without_files += !std::filesystem::exists(folder / "a.exr");
        check_whole();
        EXPECT_LE(temporaries(), 1u);  // Those of the kills before are gone.
    }
    ASSERT_EQ(run_gnomon(folder, render).exit_code, 0);
    EXPECT_EQ(names(), (Names{"a.exr", "a.gltf", "a.json", "a.png"}));
    check_whole();
    std::printf("%zu killed: %zu left a temporary file, %zu no picture\n", killed, with_temporaries, without_files);
    EXPECT_EQ(killed, wanted);
}

}  // namespace
}  // namespace gnomon::test
