// SPDX-License-Identifier: Apache-2.0
// What the benchmark derives from counts, on numbers worked out by hand.
#include "bench/work.hpp"

#include <gmock/gmock.h>

#include <gnomon/error.hpp>

namespace gnomon::bench {
namespace {

// 16x8 pixels, two tiles, 4 samples per pixel.
Frame hand_made() {
    Frame frame;
    frame.width = 16;
    frame.height = 8;
    frame.light_count = 2;
    frame.stats.counts = {{"samples", 512},      {"camera_tests", 5120},  {"bin_entries.0", 30},
                          {"bin_entries.1", 20}, {"ranges.0", 600},       {"ranges.1", 400},
                          {"shadow_tests", 200}, {"ranges_visited", 900}, {"ranges_tested", 300}};
    return frame;
}

const std::vector<FrameStats::Stage> kStages = {
    {"sample/trace", 0.001, 1}, {"raster/count", 0.003, 1}, {"raster/fill", 0.001, 1}, {"scan", 5.0, 1}};

TEST(Work, OfAFrame) {
    const Work work = work_of(hand_made(), kStages, 2);
    EXPECT_DOUBLE_EQ(work.tests_per_sample, 10.0);
    EXPECT_DOUBLE_EQ(work.traced_tests, 5120.0);
    EXPECT_EQ(work.light_entries, 50u);
    EXPECT_EQ(work.ranges, 1000u);
    EXPECT_DOUBLE_EQ(work.core_ns_per_8_tests.value(), 2e6 / 640.0);
    EXPECT_DOUBLE_EQ(work.ranges_per_second.value(), 250000.0);
    EXPECT_DOUBLE_EQ(work.visited_per_shadow_test.value(), 4.5);
    EXPECT_DOUBLE_EQ(work.tested_per_shadow_test.value(), 1.5);
    EXPECT_DOUBLE_EQ(work.trace_yardstick_seconds.value(), 640.0 * kTraceYardstickNs * 1e-9 / 2.0);
    EXPECT_DOUBLE_EQ(work.raster_yardstick_seconds.value(), 400.0 * kRasterYardstickNs * 1e-9 / 2.0);
}

TEST(Work, TestsOfSamplesOutsideTheImageCount) {
    Frame frame = hand_made();
    frame.height = 4;
    frame.stats.counts["samples"] = 256;
    const Work work = work_of(frame, kStages, 2);
    EXPECT_DOUBLE_EQ(work.tests_per_sample, 20.0);
}

TEST(Work, WhatIsNotKnownIsEmpty) {
    Frame frame = hand_made();
    frame.stats.counts["shadow_tests"] = 0;
    const Work work = work_of(frame, {}, 0);
    EXPECT_FALSE(work.core_ns_per_8_tests);
    EXPECT_FALSE(work.ranges_per_second);
    EXPECT_FALSE(work.visited_per_shadow_test);
    EXPECT_FALSE(work.trace_yardstick_seconds);
    frame.stats.counts.erase("ranges_visited");
    EXPECT_THROW(work_of(frame, {}, 0), Error);
}

TEST(Agreement, CountsHitsAndShadows) {
    Frame a, b;
    a.light_count = b.light_count = 2;
    const uint32_t miss = SampleRecord::kMiss;
    a.samples = {{1, 1.0f, 0b11}, {2, 1.0f, 0b01}, {miss, 0.0f, 0}, {4, 1.0f, 0b11}};
    b.samples = {{1, 1.0f, 0b11}, {2, 1.0f, 0b10}, {miss, 0.0f, 0}, {5, 1.0f, 0b11}};
    const Agreement agreement = agreement_of(a, b);
    EXPECT_EQ(agreement.samples, 4u);
    EXPECT_EQ(agreement.hits_agree, 3u);
    EXPECT_EQ(agreement.shadow_tests, 4u);
    EXPECT_EQ(agreement.shadows_agree, 2u);
    EXPECT_DOUBLE_EQ(agreement.hit_share(), 0.75);
    EXPECT_DOUBLE_EQ(agreement.shadow_share(), 0.5);
}

TEST(PictureErrors, OfColoursAndOfVisibility) {
    Frame a, b;
    a.channels = {{"R", {1.0f, 0.0f}},
                  {"B", {3.0f, 1.0f}},
                  {"Z", {9.0f, 9.0f}},
                  {"visibility.0", {0.5f, 1.0f}},
                  {"visibility_var.0", {9.0f, 0.0f}}};
    b.channels = {{"R", {2.0f, 1.0f}},
                  {"B", {4.0f, 1.0f}},
                  {"Z", {1.0f, 1.0f}},
                  {"visibility.0", {1.0f, 1.0f}},
                  {"visibility_var.0", {0.0f, 0.0f}}};
    const PictureErrors errors = errors_of(a, b);
    EXPECT_DOUBLE_EQ(errors.colour, 3.0 / 8.0);
    EXPECT_DOUBLE_EQ(errors.visibility, 0.25);
    EXPECT_EQ(errors_of(b, b).colour, 0.0);
}

}  // namespace
}  // namespace gnomon::bench
