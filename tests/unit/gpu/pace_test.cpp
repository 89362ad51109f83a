// SPDX-License-Identifier: Apache-2.0
// How dispatches are cut, with made-up times, and on the device.
#include "gpu/pace.hpp"

#include <algorithm>

#include "gpu_test.hpp"
#include "gpu_test_heavy.spv.h"

namespace gnomon::gpu {
namespace {

TEST(SpreadGroups, RowsAreOfEqualLengthAndFewGroupsAreIdle) {
    for (const uint64_t longest_row : {1u, 64u, 1000u, 65535u}) {
        for (const uint64_t groups : {1u, 2u, 63u, 64u, 65u, 1000u, 65535u, 65536u, 1000003u}) {
            const Grid grid = spread_groups(groups, 65535, longest_row);
            EXPECT_GE(grid.x * grid.y, groups);
            EXPECT_LT(grid.x * grid.y - groups, grid.y);
            EXPECT_LE(grid.y, 65535u);
            if (groups <= 65535 * longest_row) {
                EXPECT_LE(grid.x, longest_row);
            }
        }
    }
    EXPECT_EQ(spread_groups(9, 3, 64).x, 3u);
    EXPECT_GT(spread_groups(10, 3, 64).x, 3u) << "more than the device can run";
}

// Pieces may take 0.2 seconds.
class PaceTest : public testing::Test {
protected:
    void expect_next(uint64_t left, uint64_t groups, bool probe) {
        const Pace::Piece piece = pace.next("stage", left);
        EXPECT_EQ(piece.groups, groups) << "of " << left;
        EXPECT_EQ(piece.probe, probe) << "of " << left;
    }

    Pace pace{0.2};
};

TEST_F(PaceTest, WhatIsUnknownIsProbed) {
    expect_next(10, 10, false);
    expect_next(256, 256, false);
    expect_next(257, 256, true);
    pace.measured("stage", 256, 1e-4);
    expect_next(1024, 1024, false);
    expect_next(1000000, 1024, true);
    EXPECT_EQ(pace.next("another stage", 1000000).groups, 256u);
    pace.measured("stage", 1024, 1e-4);
    expect_next(1000000, 4096, true);
}

TEST_F(PaceTest, PiecesTakeTheirTime) {
    pace.measured("stage", 256, 0.4);
    const Pace::Piece piece = pace.next("stage", 1000);
    EXPECT_EQ(piece.groups, 128u);
    EXPECT_NEAR(piece.seconds, 0.2, 1e-9);
    EXPECT_FALSE(piece.probe);
    EXPECT_LE(static_cast<double>(pace.longest_row("stage")) * 0.4 / 256, 0.05) << "some rows are a piece";
    pace.measured("stage", 128, 1000.0);
    EXPECT_EQ(pace.next("stage", 1000).groups, 1u) << "a workgroup cannot be cut";
    EXPECT_EQ(pace.longest_row("stage"), 1u);
}

TEST_F(PaceTest, KnowsTheSlowestAndForgetsIt) {
    pace.measured("stage", 1000, 1.0);
    pace.measured("stage", 1000, 2.0);
    expect_next(1000, 100, false);
    pace.measured("stage", 100, 0.15);
    expect_next(1000, 102, false);
    for (int i = 0; i < 300; ++i) pace.measured("stage", pace.next("stage", 100000).groups, 1e-3);
    EXPECT_GT(pace.next("stage", 100000).groups, 3999u) << "as many as were measured, and more";
}

// A few workgroups take as long as one.
TEST_F(PaceTest, FewGroupsSayLittleOfMany) {
    pace.measured("stage", 100000, 0.01);
    for (int i = 0; i < 100; ++i) pace.measured("stage", 3, 20e-6);
    expect_next(100000, 100000, false);
    pace.measured("stage", 3, 0.15);
    expect_next(100000, 4, false);
}

struct HeavyParams {
    uint32_t count;
    uint32_t steps;
};

constexpr uint32_t kCount = 5000;
constexpr uint32_t kSteps = 10000;

struct Outcome {
    std::vector<uint32_t> results;
    std::vector<StageTime> times;
    double longest;
};

// Seconds within which a GPU does all of it.
constexpr double kNotWorthCutting = 2e-3;

// A dispatch from which its pace is learnt, and two that are measured.
Outcome run(const char* limits) {
    const ScopedVariable lowered("GNOMON_LIMITS", limits);
    Device device("", true);
    const Program program = device.program({"heavy", gpu_test_heavy});
    const Buffer results = upload_new(device, "results", std::vector<uint32_t>(kCount, 0));
    const std::vector<Binding> bindings{{.name = "Results", .buffer = &results}};
    Recorder recorder(device);
    const auto record = [&] { recorder.dispatch("heavy", program, bindings, HeavyParams{kCount, kSteps}, kCount); };
    record();
    recorder.submit();
    EXPECT_GT(device.longest_dispatch_seconds(), 0.0);
    device.reset_statistics();
    EXPECT_EQ(device.longest_dispatch_seconds(), 0.0);
    record();
    record();
    recorder.submit();
    return {download_vector<uint32_t>(device, results, kCount), device.stage_times(), device.longest_dispatch_seconds()};
}

TEST(CutDispatches, GiveTheSameInPieces) {
    const Outcome whole = run("");
    const Outcome cut = run("dispatch_ms=1");
    EXPECT_EQ(cut.results, whole.results);
    ASSERT_EQ(cut.times.size(), 1u);
    EXPECT_EQ(cut.times[0].dispatches, 2u) << "however many pieces";
    EXPECT_EQ(whole.times.at(0).dispatches, 2u);
    EXPECT_GT(cut.longest, 0.0);
    EXPECT_LT(cut.longest, std::max(kNotWorthCutting, cut.times[0].seconds / 10)) << "of two dispatches";
}

TEST(CutDispatches, WorkWithoutTimestamps) {
    const Outcome whole = run("");
    const Outcome cut = run("dispatch_ms=1,timestamps=0");
    EXPECT_EQ(cut.results, whole.results);
    EXPECT_EQ(cut.times.at(0).dispatches, 2u);
    EXPECT_EQ(cut.times[0].seconds, 0.0);
    EXPECT_GT(cut.longest, 0.0);
    EXPECT_LT(cut.longest, std::max(kNotWorthCutting, whole.times.at(0).seconds / 5));
}

TEST(CutDispatches, MayBeOfOneGroup) {
    const ScopedVariable lowered("GNOMON_LIMITS", "dispatch_ms=0");
    Device device("", true);
    const Program program = device.program({"heavy", gpu_test_heavy});
    const Buffer results = upload_new(device, "results", std::vector<uint32_t>(700, 0));
    const std::vector<Binding> bindings{{.name = "Results", .buffer = &results}};
    Recorder recorder(device);
    for (int i = 0; i < 2; ++i) recorder.dispatch("heavy", program, bindings, HeavyParams{700, 0}, 700);
    recorder.submit();
    std::vector<uint32_t> expected = iota(700);
    for (uint32_t& value : expected) value = 2 * (8 * value + 28);
    EXPECT_EQ(download_vector<uint32_t>(device, results, 700), expected);
}

}  // namespace
}  // namespace gnomon::gpu
