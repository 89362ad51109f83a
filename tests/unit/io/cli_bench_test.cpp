// SPDX-License-Identifier: Apache-2.0
// `gnomon bench` as its users see it. Needs a Vulkan device; without one most tests say that they are skipped.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "command_runner.hpp"
#include "support/paths.hpp"
#include "test_folder.hpp"

namespace gnomon::test {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class CliBenchTest : public TestFolder {
protected:
    static std::string scene() { return std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/scenes/two-cubes.gltf"; }

    CommandResult bench(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"bench", "--size=64x48", "--spp=4", "--shadow-res=64"});
        return run_gnomon(folder, arguments);
    }
};

TEST_F(CliBenchTest, ALittleRun) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const CommandResult result = bench({scene(), "--layout", "array,array-soa", "--repetitions=3", "--json=a.json",
                                        "--csv=a.csv", "--axis", "cells=2,4", "--artifact", "all"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("two-cubes, cells=2: 3 repetitions on "));
    EXPECT_THAT(result.out, HasSubstr("array (again)"));

    const json document = json::parse(content_of(folder / "a.json")), gnomon = document["gnomon"];
    EXPECT_EQ(gnomon["baseline"], "array");
    EXPECT_EQ(gnomon["axes"], json::parse(R"([{"name": "layout", "values": ["array", "array-soa", "null"]},
                                              {"name": "cells", "values": ["2", "4"]}])"));
    std::vector<std::string> names;
    for (json measured : gnomon["cases"]) {  // A copy: what is not there is null.
        names.push_back(measured["name"]);
        if (measured["axes"]["cells"] != "2") continue;
        for (const char* metric : {"clear", "count", "scan", "prepare", "fill", "finish", "query", "build", "frame", "cpu"})
            EXPECT_EQ(measured["stages"][metric]["samples"].size(), 3u) << metric;
        const bool null = measured["layout"] == "null";
        json& counts = measured["counts"];
        EXPECT_EQ(counts["lost"], null ? counts["ranges"] : json());
        EXPECT_GT(measured["stages"]["build"]["median"], 0.0);
        EXPECT_EQ(measured["floor"]["bytes"], counts["map_bytes"]);
        EXPECT_EQ(counts.contains("sectors_per_query"), true);
        EXPECT_EQ(counts["sectors_per_query"] > 0.0, !null);
        EXPECT_EQ(counts["atomics"] > 0.0, null);  // Of its counter of what is lost.
        if (measured["again"]) continue;
        EXPECT_EQ(measured["same_picture"], null ? json() : json(true));
        uint64_t lists = 0;
        for (const json& bucket : measured["lengths"]) lists += bucket["lists"].get<uint64_t>();
        EXPECT_LE(lists, counts["lists"].get<uint64_t>());  // Of partial tiles some lie outside.
        EXPECT_GT(lists, counts["lists"].get<uint64_t>() / 2);
        EXPECT_EQ(measured.contains("texels"), measured["layout"] == "array");
    }
    EXPECT_THAT(names, ElementsAre("two-cubes/array/cells=2", "two-cubes/array-soa/cells=2", "two-cubes/array (again)/cells=2",
                                   "two-cubes/null/cells=2", "two-cubes/array/cells=4", "two-cubes/array-soa/cells=4",
                                   "two-cubes/array (again)/cells=4", "two-cubes/null/cells=4"));
    EXPECT_EQ(gnomon["comparisons"].size(), 2u * 2u * 3u);
    for (const json& comparison : gnomon["comparisons"]) EXPECT_EQ(comparison["verdict"], "undecided");  // Of three.
    EXPECT_EQ(document["benchmarks"].size(), 8u * 3u * (3u + 4u));

    const std::string csv = content_of(folder / "a.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 8 * 11 * 3);
    EXPECT_EQ(content_of(folder / "all" / "results.csv"), csv);
    for (const char* file : {"results.json", "run.sh", "system.txt", "CITATION.cff", "README.md", "scenes/1/two-cubes.bin"})
        EXPECT_TRUE(std::filesystem::exists(folder / "all" / file)) << file;
    EXPECT_THAT(content_of(folder / "all" / "run.sh"),
                HasSubstr("bench --size=64x48 --spp=4 --shadow-res=64 scenes/1/two-cubes.gltf --layout array,array-soa "
                          "--repetitions=3 --axis cells=2,4 --json again.json"));
}

TEST_F(CliBenchTest, WhatIsLeftOutIsSaid) {
    GN_SKIP_WITHOUT_DEVICE(run_gnomon(folder, {"devices"}));
    const CommandResult lossy = bench({"--synthetic", "lengths=spike,mean=2", "--layout", "array,fixed,no-depth", "--method",
                                       "dtr-analytic", "--repetitions=1", "--no-null", "--json=-"});
    EXPECT_EQ(lossy.exit_code, 7) << lossy.err;  // Spikes are longer than what is fixed.
    const json gnomon = json::parse(lossy.out)["gnomon"];
    ASSERT_EQ(gnomon["skipped"].size(), 1u);
    EXPECT_EQ(gnomon["skipped"][0]["case"], "synthetic-spike-2/no-depth");
    EXPECT_THAT(gnomon["skipped"][0]["reason"].get<std::string>(), HasSubstr("only contains them"));
    EXPECT_EQ(gnomon["cases"].size(), 3u);

    const CommandResult slow = bench({scene(), "--layout", "array", "--timeout", "1e-6", "--no-null"});
    EXPECT_EQ(slow.exit_code, 2);
    EXPECT_THAT(slow.err, HasSubstr("nothing could be measured: its frames took more than"));
    EXPECT_THAT(slow.out, HasSubstr("left out: its frames took more than"));
}

TEST_F(CliBenchTest, SaysWhatIsWrong) {
    const auto refused = [&](std::vector<std::string> arguments, int exit_code, const std::string& why) {
        SCOPED_TRACE(why);
        const CommandResult result = bench(std::move(arguments));
        EXPECT_EQ(result.exit_code, exit_code);
        EXPECT_THAT(result.err, HasSubstr(why));
        EXPECT_THAT(result.out, Not(HasSubstr("median")));
    };
    refused({}, 2, "there is nothing to measure");
    refused({scene(), "--axis", "tile=4"}, 2, "tile cannot be varied");
    refused({scene(), "--axis", "spp=2", "--axis", "spp=4"}, 2, "the axis spp is given twice");
    refused({scene(), "--layout", "array,heap"}, 2, "heap");
    refused({scene(), "--layout", "array,array"}, 2, "two layouts are called array");
    refused({scene(), "--layout", "array", "--baseline", "linked"}, 2, "the baseline linked is not measured");
    refused({scene(), "--method", "tsm"}, 2, "method tsm has no S-buffer");
    refused({scene(), "--repetitions", "0"}, 2, "--repetitions");
    refused({scene(), "--json", "a.txt"}, 2, "--json");
    refused({scene(), "--artifact", "."}, 3, "there is something of that name");
    refused({"no-such.gltf"}, 3, "no-such.gltf");
}

}  // namespace gnomon::test
