// SPDX-License-Identifier: Apache-2.0
// The parts of `gnomon bench` that need no device.
#include <gmock/gmock.h>

#include <numeric>
#include <set>

#include "bench_axes.hpp"
#include "bench_counts.hpp"
#include "bench_report.hpp"
#include "synthetic_scene.hpp"
#include "throws.hpp"

namespace gnomon::test {

using cli::BenchCase;
using cli::BenchGroup;
using cli::Synthetic;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

TEST(BenchAxes, AreSetByTheirValues) {
    const cli::Axis axis = cli::parse_axis("shadow-res=256,512");
    EXPECT_EQ(axis.name, "shadow-res");
    EXPECT_THAT(axis.values, ElementsAre("256", "512"));
    BenchGroup point;
    for (const auto& [name, value] : cli::AxisValues{{"shadow-res", "512"},
                                                     {"cells", "8"},
                                                     {"spp", "3"},
                                                     {"speed", "2.5"},
                                                     {"method", "dtr"},
                                                     {"size", "48x32"},
                                                     {"time-steps", "2"},
                                                     {"raster", "prism"},
                                                     {"pages", "all"},
                                                     {"memory-budget", "64M"}})
        cli::set_axis(name, value, point);
    EXPECT_EQ(point.settings.shadow_res, 512u);
    EXPECT_EQ(point.settings.light_cells, 8u);
    EXPECT_EQ(point.settings.spp, 3u);
    EXPECT_EQ(point.speed, 2.5);
    EXPECT_EQ(point.settings.method, "dtr");
    EXPECT_EQ(point.settings.width, 48u);
    EXPECT_EQ(point.settings.height, 32u);
    EXPECT_EQ(point.time_steps, 2u);
    EXPECT_EQ(point.settings.raster, "prism");
    EXPECT_EQ(point.settings.pages, "all");
    EXPECT_EQ(point.settings.memory_budget, 64u << 20);
}

TEST(BenchAxes, SayWhatIsWrong) {
    const auto refused = [](const std::string& text, const std::string& why) {
        EXPECT_GNOMON_ERROR(cli::parse_axis(text), ErrorKind::usage, why);
    };
    refused("tile=4,8", "tile cannot be varied: tiles are of 8x8 texels");
    refused("layout=array", "use --layout A,B");
    refused("heap=1", "there is no axis 'heap', --axis; use shadow-res, cells, ");
    refused("cells", "'cells' is not an axis");
    refused("cells=", "'cells=' is not an axis");
    refused("=1", "'=1' is not an axis");
    refused("spp=4,4", "the value '4' twice");
    refused("spp=4,,8", "--axis spp");
    refused("cells=0", "--axis cells");
    refused("cells=129", "--axis cells");
    refused("speed=-1", "--axis speed");
    refused("size=12", "--axis size");
    refused("pages=some", "no pages 'some'");
    refused("method=tsm", "method tsm has no S-buffer");
    refused("method=none", "no method 'none'");
}

TEST(BenchAxes, CombineInOrder) {
    const auto all = cli::combinations({{"spp", {"1", "2"}}, {"cells", {"4", "8"}}});
    ASSERT_EQ(all.size(), 4u);
    EXPECT_THAT(all[0], ElementsAre(Pair("spp", "1"), Pair("cells", "4")));
    EXPECT_THAT(all[1], ElementsAre(Pair("spp", "1"), Pair("cells", "8")));
    EXPECT_THAT(all[3], ElementsAre(Pair("spp", "2"), Pair("cells", "8")));
    EXPECT_THAT(cli::combinations({}), ElementsAre(ElementsAre()));
}

TEST(BenchMetrics, AreSumsOfStages) {
    FrameStats stats;
    stats.wall_seconds = 0.1;
    stats.stages = {{"scan", 0.001, 1},          {"raster/count", 0.002, 1},   {"sbuffer/scan", 0.003, 1},
                    {"sbuffer/clear", 0.004, 1}, {"sbuffer/prepare", 0.01, 1}, {"raster/fill", 0.005, 1},
                    {"sbuffer/size", 0.001, 1},  {"sbuffer/finish", 0.006, 1}, {"sample/shadow", 0.02, 1}};
    const std::map<std::string, double> metrics = cli::metrics_of(stats, 0.15);
    EXPECT_EQ(metrics.size(), cli::bench_metrics().size());
    EXPECT_DOUBLE_EQ(metrics.at("clear"), 4.0);
    EXPECT_DOUBLE_EQ(metrics.at("count"), 3.0);
    EXPECT_DOUBLE_EQ(metrics.at("scan"), 3.0);
    EXPECT_DOUBLE_EQ(metrics.at("prepare"), 10.0);
    EXPECT_DOUBLE_EQ(metrics.at("fill"), 5.0);
    EXPECT_DOUBLE_EQ(metrics.at("finish"), 6.0);
    EXPECT_DOUBLE_EQ(metrics.at("query"), 20.0);
    EXPECT_DOUBLE_EQ(metrics.at("build"), 31.0);
    EXPECT_DOUBLE_EQ(metrics.at("rest"), 49.0);
    EXPECT_DOUBLE_EQ(metrics.at("frame"), 100.0);
    EXPECT_DOUBLE_EQ(metrics.at("cpu"), 150.0);
    stats.timed = false;
    EXPECT_EQ(cli::metrics_of(stats, 0.15).size(), 2u);
}

TEST(BenchCounts, AreSumsOverLights) {
    FrameStats stats;
    stats.counts = {{"ranges.0", 5}, {"ranges.1", 7}, {"bin_entries.camera", 2}};
    stats.peak_bytes = 11;
    EXPECT_THAT(cli::counts_of(stats),
                UnorderedElementsAre(Pair("ranges", 12.0), Pair("bin_entries.camera", 2.0), Pair("peak_bytes", 11.0)));
}

TEST(BenchCounts, OfAccessesAreMeans) {
    const LayoutAccesses accesses{.groups = 2,
                                  .queries = 40,
                                  .reads = 100,
                                  .bytes = 1000,
                                  .distinct_bytes = 480,
                                  .sectors = 20,
                                  .lines = 10,
                                  .requests = 8,
                                  .request_sectors = 24,
                                  .turns = 4,
                                  .visits = 32,
                                  .most_reads = 7,
                                  .chained_reads = 60,
                                  .longest_chain = 5,
                                  .atomics = 9,
                                  .most_atomics = 3,
                                  .held_bytes = 64,
                                  .used_bytes = 48};
    EXPECT_THAT(
        cli::counts_of(accesses),
        UnorderedElementsAre(Pair("counted_groups", 2.0), Pair("reads_per_query", 2.5), Pair("bytes_per_query", 25.0),
                             Pair("chain_per_query", 1.5), Pair("longest_chain", 5.0), Pair("sectors_per_query", 0.5),
                             Pair("lines_per_query", 0.25), Pair("sectors_per_request", 3.0), Pair("useful_share", 0.75),
                             Pair("lane_activity", 0.25), Pair("most_reads_of_a_query", 7.0), Pair("atomics", 9.0),
                             Pair("most_atomics_on_one", 3.0), Pair("held_bytes", 64.0), Pair("used_bytes", 48.0)));
    // Of a layout that reads nothing there is nothing to share out.
    EXPECT_THAT(cli::counts_of(LayoutAccesses{}), testing::SizeIs(7));
}

TEST(BenchCounts, TexelsAreAddedUp) {
    // 300 texels in 3 x 3: the last row and column are partial.
    std::vector<uint32_t> ranges(300 * 299, 1);
    ranges[0] = 10;
    const cli::TexelGrid grid = cli::texel_grid(ranges, 300);
    EXPECT_EQ(grid.width, 100u);
    EXPECT_EQ(grid.height, 100u);
    EXPECT_EQ(grid.ranges[0], 18u);
    EXPECT_EQ(grid.ranges[1], 9u);
    EXPECT_EQ(grid.ranges.back(), 6u);
    EXPECT_EQ(std::accumulate(grid.ranges.begin(), grid.ranges.end(), uint64_t{0}), 300u * 299u + 9u);
    EXPECT_EQ(cli::texel_grid({1, 2, 3, 4}, 2).ranges, (std::vector<uint64_t>{1, 2, 3, 4}));
    EXPECT_EQ(cli::texel_grid({}, 2).width, 0u);
}

TEST(BenchSynthetic, HeightsFollowTheDistribution) {
    const auto heights = [](const std::string& text, uint32_t stacks) {
        return cli::stack_heights(cli::parse_synthetic(text), stacks);
    };
    // 8 stacks of 32 triangles: 32 / 64 * (i + 0.5) * 2, 1/1 to 1/8 over 2.7179, and half of them in one.
    EXPECT_THAT(heights("lengths=uniform,mean=4", 8), ElementsAre(1, 1, 3, 3, 5, 5, 7, 7));
    EXPECT_THAT(heights("lengths=zipf,mean=4", 8), ElementsAre(12, 6, 4, 3, 2, 2, 2, 1));
    EXPECT_THAT(heights("lengths=spike,mean=4", 8), ElementsAre(16, 2, 3, 2, 2, 2, 3, 2));
    for (const char* lengths : {"uniform", "zipf", "spike"}) {
        const auto all = heights(std::string("lengths=") + lengths + ",mean=7.5", 512);
        EXPECT_EQ(std::accumulate(all.begin(), all.end(), 0u), 3840u) << lengths;
    }
    EXPECT_THAT(heights("lengths=zipf,mean=0", 3), ElementsAre(0, 0, 0));
}

TEST(BenchSynthetic, SaysWhatIsWrong) {
    const auto refused = [](const std::string& text, const std::string& why) {
        EXPECT_GNOMON_ERROR(cli::parse_synthetic(text), ErrorKind::usage, why);
    };
    refused("mean=8", "lengths are not given");
    refused("lengths=normal", "there are no lengths 'normal', --synthetic; use uniform, zipf, spike");
    refused("lengths=zipf,mean=many", "--synthetic mean");
    refused("lengths=zipf,order=reverse", "there are no order 'reverse'");
    refused("lengths=zipf,depth=8", "there is no 'depth'");
}

TEST(BenchSynthetic, OrdersDifferInTheOrderAlone) {
    std::set<std::string> names;
    std::vector<std::multiset<float>> heights;
    std::vector<std::vector<float>> sequences;
    for (const char* order : {"as-is", "shuffled", "sorted"}) {
        const Synthetic synthetic = cli::parse_synthetic(std::string("lengths=zipf,mean=3,order=") + order);
        names.insert(synthetic.name());
        const Scene scene = cli::synthetic_scene(synthetic, 7);
        ASSERT_EQ(scene.triangles.size(), 2u + 3u * 512u);
        auto& sequence = sequences.emplace_back();
        for (size_t i = 2; i < scene.triangles.size(); ++i)
            sequence.push_back(scene.vertices[scene.triangles[i].vertex[0]].position.y);
        heights.emplace_back(sequence.begin(), sequence.end());
    }
    EXPECT_THAT(names, ElementsAre("synthetic-zipf-3", "synthetic-zipf-3-shuffled", "synthetic-zipf-3-sorted"));
    EXPECT_EQ(heights[0], heights[1]);
    EXPECT_EQ(heights[0], heights[2]);
    EXPECT_NE(sequences[0], sequences[1]);
    EXPECT_TRUE(std::is_sorted(sequences[2].rbegin(), sequences[2].rend()));
}

// Half before the middle of the shutter, half behind it.
TEST(BenchSynthetic, MovesByItsSpeed) {
    const std::vector<Pose> poses = cli::synthetic_poses(2.0, 2);
    ASSERT_EQ(poses.size(), 3u);
    EXPECT_EQ(poses[0].palette[0].w, -0.125f);
    EXPECT_EQ(poses[1].palette[0].w, 0.0f);
    EXPECT_EQ(poses[2].palette[0].w, 0.125f);
    EXPECT_EQ(cli::synthetic_poses(0.0, 1)[0].palette, cli::synthetic_poses(0.0, 1)[1].palette);
}

// Two layouts, two repetitions, by hand.
cli::BenchResults two_by_two() {
    cli::BenchResults results;
    results.command = {"gnomon", "bench"};
    results.repetitions = 2;
    results.layouts = {{"array", "array"}, {"my, own", "my, own"}};
    results.axes = {{"spp", {"4"}}};
    results.copy_bytes_per_second = 1e6;
    BenchGroup& group = results.groups.emplace_back();
    group.scene = "scene";
    group.axes = {{"spp", "4"}};
    for (const char* name : {"array", "my, own", "null", "slow"}) {
        BenchCase& added = group.cases.emplace_back();
        added.layout = {name, name};
        added.name = "scene/" + std::string(name) + "/spp=4";
        added.samples = {{"query", {1.0, 2.0}}, {"cpu", {3.0, 4.0}}};
    }
    group.cases[1].samples["query"] = {2.0, 6.0};
    group.cases[1].counts = {{"map_bytes", 2000.0}, {"sectors_per_query", 1.5}};
    group.cases[1].lengths = {9, 5, 3, 2, 1, 0, 0, 0, 4};
    group.cases[2].layout.compared = false;
    group.cases[3].samples.clear();
    group.cases[3].skipped = "too slow";
    return results;
}

TEST(BenchReport, Csv) {
    EXPECT_THAT(cli::bench_csv(two_by_two()),
                HasSubstr("scene,layout,again,spp,metric,repetition,milliseconds\n"
                          "scene,array,0,4,query,0,1\nscene,array,0,4,query,1,2\nscene,array,0,4,cpu,0,3\n"
                          "scene,array,0,4,cpu,1,4\nscene,\"my, own\",0,4,query,0,2\n"));
}

TEST(BenchReport, Json) {
    const io::Json json = cli::bench_json(two_by_two());
    const io::Json& gnomon = json["gnomon"];
    ASSERT_EQ(gnomon["cases"].size(), 3u);
    const io::Json& other = gnomon["cases"][1];
    EXPECT_EQ(other["stages"]["query"]["samples"], io::Json({2.0, 6.0}));
    EXPECT_EQ(other["stages"]["query"]["q1"], 3.0);
    EXPECT_EQ(other["counts"], io::Json({{"map_bytes", 2000}, {"sectors_per_query", 1.5}}));
    EXPECT_EQ(other["floor"], io::Json({{"bytes", 2000}, {"copy_ms", 2.0}}));
    EXPECT_EQ(other["lengths"], io::Json::array({{{"from", 0}, {"to", 0}, {"lists", 9}},
                                                 {{"from", 1}, {"to", 1}, {"lists", 5}},
                                                 {{"from", 2}, {"to", 3}, {"lists", 5}},
                                                 {{"from", 4}, {"to", 7}, {"lists", 1}},
                                                 {{"from", 8}, {"to", 15}, {"lists", 4}}}));
    ASSERT_EQ(gnomon["comparisons"].size(), 1u);  // Neither the baseline nor the floor.
    EXPECT_EQ(gnomon["comparisons"][0]["case"], "scene/my, own/spp=4");
    EXPECT_EQ(gnomon["comparisons"][0]["ratio"], 2.5);
    EXPECT_EQ(gnomon["comparisons"][0]["low"], nullptr);
    EXPECT_EQ(gnomon["comparisons"][0]["verdict"], "undecided");
    EXPECT_EQ(gnomon["skipped"], io::Json::array({{{"case", "scene/slow/spp=4"}, {"reason", "too slow"}}}));

    ASSERT_EQ(json["benchmarks"].size(), 3u * (2 + 4));
    const io::Json& second = json["benchmarks"][7];
    EXPECT_EQ(second["name"], "scene/my, own/spp=4/query");
    EXPECT_EQ(second["run_type"], "iteration");
    EXPECT_EQ(second["repetition_index"], 1);
    EXPECT_EQ(second["real_time"], 6.0);
    EXPECT_EQ(second["cpu_time"], 4.0);
    EXPECT_EQ(second["time_unit"], "ms");
    EXPECT_EQ(json["benchmarks"][9]["name"], "scene/my, own/spp=4/query_median");
    EXPECT_EQ(json["benchmarks"][9]["run_type"], "aggregate");
    EXPECT_EQ(json["benchmarks"][9]["real_time"], 4.0);
}

}  // namespace gnomon::test
