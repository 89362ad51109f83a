// SPDX-License-Identifier: Apache-2.0
// The benchmark's command on its smallest settings: what it writes, not how fast it is.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/paths.hpp"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

int exit_code_of(const std::string& arguments) {
    const int status = std::system((GN_PATH(GNOMON_FRAME_BENCH) + " " + arguments).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

class FrameBench : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path folder_ = fs::temp_directory_path() / ("frame_bench_test." + std::to_string(getpid()));
};

void expect_members(const json& object, std::initializer_list<const char*> names) {
    for (const char* name : names) EXPECT_TRUE(object.contains(name)) << name << " is missing";
}

void expect_entry(const json& entry, const std::string& program) {
    EXPECT_EQ(entry["name"], "frame/two-cubes/spp:1/" + program);
    EXPECT_EQ(entry["program"], program);
    EXPECT_EQ(entry["spp"], 1);
    EXPECT_EQ(entry["time_unit"], "s");
    for (const char* seconds : {"wall_seconds", "cpu_seconds"}) {
        expect_members(entry[seconds], {"median", "min", "max"});
        EXPECT_EQ(entry[seconds]["runs"].size(), 1u) << seconds;
    }
    EXPECT_GT(entry["real_time"], 0.0);
    EXPECT_EQ(entry["real_time"], entry["wall_seconds"]["median"]);
    EXPECT_EQ(entry["cpu_time"], entry["cpu_seconds"]["median"]);
    EXPECT_GT(entry["busy_share"], 0.0);
    double seconds = entry["rest_seconds"]["median"];
    for (const json& stage : entry["stages"]) seconds += stage["seconds"].get<double>();
    EXPECT_NEAR(seconds, entry["real_time"].get<double>(), 1e-6);
    EXPECT_GT(entry["stages"].size(), 3u);
    EXPECT_EQ(entry["counts"]["samples"], 64 * 48);
}

void expect_peer_is_the_fastest(const json& embree) {
    const json* fastest = nullptr;
    for (const json& trial : embree["trials"]) {
        EXPECT_GT(trial["wall_seconds"], 0.0);
        EXPECT_GT(trial["cpu_seconds"], 0.0);
        if (trial["whole"] && (!fastest || trial["cpu_seconds"] < (*fastest)["cpu_seconds"])) fastest = &trial;
    }
    ASSERT_TRUE(fastest);
    for (const char* part : {"segments", "quality", "calls", "order"})
        EXPECT_EQ(embree["peer"][part], (*fastest)[part]) << part;
}

TEST_F(FrameBench, SmallestFrame) {
    const fs::path json_file = folder_ / "bench.json", markdown_file = folder_ / "bench.md", csv_file = folder_ / "bench.csv";
    ASSERT_EQ(exit_code_of("--scenes two-cubes --spp 1 --repeat 1 --scale 0.0625 --threads 2 --json " + json_file.string() +
                           " --markdown " + markdown_file.string() + " --csv " + csv_file.string()),
              0);

    const json bench = json::parse(text_of(json_file));
    const json& context = bench["context"];
    expect_members(context, {"date", "num_cpus", "cpu", "load_avg", "library_build_type", "device", "device_type", "driver"});
    expect_members(context["versions"], {"gnomon", "compiler"});
    EXPECT_THAT(context["versions"]["embree"].get<std::string>(), HasSubstr("Embree "));
    EXPECT_EQ(context["width"], 64);
    EXPECT_EQ(context["height"], 48);
    EXPECT_EQ(context["shadow_res"], 64);
    EXPECT_EQ(context["threads"], 2);
    EXPECT_EQ(context["repetitions"], 1);

    ASSERT_EQ(bench["benchmarks"].size(), 2u);
    const json &gnomon = bench["benchmarks"][0], &embree = bench["benchmarks"][1];
    expect_entry(gnomon, "gnomon");
    expect_entry(embree, "embree");

    EXPECT_GT(gnomon["peak_bytes"], 0);
    EXPECT_GT(gnomon["buffers"]["bin_entries"], 0);
    EXPECT_EQ(gnomon["effective"]["method"], "exact");
    EXPECT_DOUBLE_EQ(gnomon["embree_over_gnomon"]["median"].get<double>(),
                     embree["real_time"].get<double>() / gnomon["real_time"].get<double>());
    EXPECT_DOUBLE_EQ(gnomon["embree_over_gnomon_cpu"]["median"].get<double>(),
                     embree["cpu_time"].get<double>() / gnomon["cpu_time"].get<double>());
    const json& work = gnomon["work"];
    for (const char* name : {"light_entries", "ranges", "tests_per_sample", "traced_tests", "ranges_per_second",
                             "visited_per_shadow_test", "tested_per_shadow_test"}) {
        EXPECT_GT(work[name], 0) << name;
    }
    if (context["device_type"] == "cpu") {
        for (const char* name : {"core_ns_per_8_tests", "trace_yardstick_seconds", "raster_yardstick_seconds"}) {
            EXPECT_GT(work[name], 0.0) << name;
        }
    }
    EXPECT_EQ(gnomon["agreement"]["samples"], 64 * 48);
    EXPECT_GT(gnomon["agreement"]["hits"], 0.99);
    EXPECT_GT(gnomon["agreement"]["shadows"], 0.99);

    // Builds with 1 and 8 segments in three qualities, each way to ask in two orders; then the best three whole.
    const size_t calls = context["versions"]["embree"].get<std::string>().starts_with("Embree 3") ? 4 : 3;
    ASSERT_EQ(embree["trials"].size(), 6 * 2 * calls + 3);
    expect_peer_is_the_fastest(embree);
    EXPECT_EQ(embree["counts"]["time_steps"], embree["peer"]["segments"].get<int>() + 1);
    EXPECT_LT(embree["picture_errors"]["colour"], 1e-3);
    EXPECT_LT(embree["picture_errors"]["visibility"], 1e-2);

    const std::string markdown = text_of(markdown_file);
    for (const char* part : {"### Whole frames", "### Work", "### Seconds per stage, gnomon", "sample/trace", "### Yardsticks",
                             "| two-cubes | 1 |", "### Largest buffers"}) {
        EXPECT_THAT(markdown, HasSubstr(part));
    }
    EXPECT_THAT(markdown, Not(HasSubstr("Growth")));
    const std::string csv = text_of(csv_file);
    EXPECT_THAT(csv, StartsWith("scene,group,value,triangles,spp,"));
    EXPECT_THAT(csv, HasSubstr("\ntwo-cubes,frames,,"));
}

TEST_F(FrameBench, GrowthCurve) {
    const fs::path json_file = folder_ / "bench.json", markdown_file = folder_ / "bench.md", csv_file = folder_ / "bench.csv";
    ASSERT_EQ(exit_code_of("--scenes lights --spp 2 --repeat 1 --scale 0.03125 --threads 2 --json " + json_file.string() +
                           " --markdown " + markdown_file.string() + " --csv " + csv_file.string()),
              0);
    const json bench = json::parse(text_of(json_file));
    ASSERT_EQ(bench["benchmarks"].size(), 8u);
    uint64_t tests_of_one = 0;
    for (size_t i = 0; i < 4; ++i) {
        const json &gnomon = bench["benchmarks"][2 * i], &embree = bench["benchmarks"][2 * i + 1];
        EXPECT_EQ(gnomon["value"], 1 << i);
        if (i == 0) tests_of_one = gnomon["counts"]["shadow_tests"];
        EXPECT_EQ(gnomon["counts"]["shadow_tests"], tests_of_one << i);
        EXPECT_NEAR(embree["counts"]["shadow_tests"].get<double>(), static_cast<double>(tests_of_one << i), 8.0);
    }
    EXPECT_THAT(text_of(markdown_file), AllOf(HasSubstr("### Growth with lights"), HasSubstr("| random-cubes | 8 |")));
    EXPECT_THAT(text_of(csv_file), HasSubstr("\nrandom-cubes@lights=8,lights,8,"));
}

TEST_F(FrameBench, ARefusedFrameKeepsEmbreesNumbers) {
    const fs::path json_file = folder_ / "bench.json", markdown_file = folder_ / "bench.md", csv_file = folder_ / "bench.csv";
    setenv("GNOMON_LIMITS", "buffer=16384", 1);
    const int exit_code = exit_code_of("--scenes two-cubes --spp 1 --repeat 1 --scale 0.0625 --json " + json_file.string() +
                                       " --markdown " + markdown_file.string() + " --csv " + csv_file.string());
    unsetenv("GNOMON_LIMITS");
    ASSERT_EQ(exit_code, 0);
    const json bench = json::parse(text_of(json_file));
    EXPECT_EQ(bench["benchmarks"][0]["error_occurred"], true);
    EXPECT_THAT(bench["benchmarks"][0]["error_message"].get<std::string>(), HasSubstr("no memory"));
    EXPECT_GT(bench["benchmarks"][1]["real_time"], 0.0);
    EXPECT_THAT(text_of(markdown_file),
                AllOf(HasSubstr("| two-cubes | 1 | - |"), HasSubstr("- two-cubes: no memory"), Not(HasSubstr("### Work"))));
    EXPECT_THAT(text_of(csv_file), HasSubstr(",64,48,64,,,"));
}

TEST_F(FrameBench, ListsItsScenes) {
    ASSERT_EQ(exit_code_of("--help > " + (folder_ / "help").string()), 0);
    const std::string help = text_of(folder_ / "help");
    for (const char* name : {"random-cubes@motion=16", "stadium-1m", "two-cubes-4k", "pillars"})
        EXPECT_THAT(help, HasSubstr(name));
}

TEST_F(FrameBench, NamesWhatItCannotDo) {
    EXPECT_EQ(exit_code_of("--scenes teapot"), 2);
    EXPECT_EQ(exit_code_of("--spp 0"), 2);
    EXPECT_EQ(exit_code_of("--json " + (folder_ / "nowhere/bench.json").string()), 3);
}

}  // namespace
}  // namespace gnomon
