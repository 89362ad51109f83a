// SPDX-License-Identifier: Apache-2.0
// What is counted of a layout's accesses: on hand-worked records, and in frames, where other counts say how many there must be.
#include "layouts/accesses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/error.hpp>
#include <gnomon/render.hpp>

#include "gpu/reflection.hpp"
#include "layouts/compile_layout.hpp"
#include "layouts/layout.hpp"
#include "stages/programs.hpp"
#include "support/two_cubes.hpp"
#include "unit/io/throws.hpp"

namespace gnomon::test {
namespace {

using shared::kQueryBegins;
using shared::kTurnBegins;
using shared::LayoutRead;

constexpr uint32_t kRound = 0x10000;

/// Of the shadow test compiled for a layout.
Dependences dependences_of(const std::string& layout, const std::vector<std::string>& names) {
    return Dependences(find_shader("sample/shadow@" + layout).spirv, names);
}

TEST(DependencesTest, OfAnArrayEndAtItsRanges) {
    for (const char* layout : {"array", "array+storage"}) {
        SCOPED_TRACE(layout);
        const Dependences found = dependences_of(layout, {"offsets_of_ranges", "ranges"});
        EXPECT_FALSE(found.waits_for(0, 0));
        EXPECT_FALSE(found.waits_for(0, 1));
        EXPECT_TRUE(found.waits_for(1, 0));
        EXPECT_FALSE(found.waits_for(1, 1));
        EXPECT_EQ(found.longest_chain(std::vector<uint32_t>{2, 100}), 2u);
        EXPECT_EQ(found.longest_chain(std::vector<uint32_t>{2, 0}), 1u);
        EXPECT_EQ(found.longest_chain(std::vector<uint32_t>{0, 0}), 0u);
    }
}

TEST(DependencesTest, OfALinkedListGoFromNodeToNode) {
    for (const char* layout : {"linked", "linked+storage"}) {
        SCOPED_TRACE(layout);
        const Dependences found = dependences_of(layout, {"heads", "links", "ranges"});
        EXPECT_FALSE(found.waits_for(0, 1));
        EXPECT_TRUE(found.waits_for(1, 0));
        EXPECT_TRUE(found.waits_for(1, 1));
        EXPECT_FALSE(found.waits_for(1, 2));
        EXPECT_TRUE(found.waits_for(2, 1));
        EXPECT_FALSE(found.waits_for(2, 2));
        EXPECT_EQ(found.longest_chain(std::vector<uint32_t>{1, 0, 0}), 1u);
        EXPECT_EQ(found.longest_chain(std::vector<uint32_t>{1, 7, 7}), 1u + 7 + 1);
    }
}

// Branches for all ranges (query.all), which the shadow test never asks for, lead from head to head and from word to word.
TEST(DependencesTest, BranchesOfAConstantAreCutOff) {
    std::set<std::string> bound;
    for (const gpu::Resource& resource : gpu::reflect(find_shader("sample/shadow@array"), {}).resources)
        bound.insert(resource.name);
    const auto of = [&](const std::string& layout, const std::vector<std::string>& names) {
        return Dependences(compile_stage("sample/shadow", find_layout(layout), false, bound), names);
    };
    const Dependences bits = of("bits", {"offsets_of_triangles", "rows", "listed"});
    EXPECT_TRUE(bits.waits_for(1, 0));
    EXPECT_FALSE(bits.waits_for(1, 1));
    EXPECT_FALSE(bits.waits_for(1, 2));
    EXPECT_TRUE(bits.waits_for(2, 1));
    const Dependences buckets = of("linked-buckets", {"heads", "links"});
    EXPECT_FALSE(buckets.waits_for(0, 0));
    EXPECT_FALSE(buckets.waits_for(0, 1));
    EXPECT_TRUE(buckets.waits_for(1, 0));
    EXPECT_TRUE(buckets.waits_for(1, 1));
}

TEST(DependencesTest, WhatIsNoModule) {
    EXPECT_GNOMON_ERROR(Dependences(std::vector<uint32_t>{1, 2, 3}, {}), ErrorKind::internal, "not a SPIR-V module");
}

TEST(AccessesTest, OfRecordsByHand) {
    // Offsets of 4 bytes are buffer 1, ranges of 16 bytes buffer 0. Two hits of a group: their records come mixed, as a device
    // writes them.
    const std::vector<LayoutRead> reads = {{0, 0, kQueryBegins, 0},
                                           {1, 0, kQueryBegins, 0},
                                           {0, 0, 1, 0},
                                           {1, 0, 1, 1},
                                           {0, 0, 1, 1},
                                           {0, kRound + 1, kTurnBegins, 0},
                                           {1, 0, 1, 2},
                                           {1, kRound + 1, kTurnBegins, 0},
                                           {1, kRound + 1, 0, 1},
                                           {0, kRound + 1, 0, 0},
                                           {0, kRound + 2, kTurnBegins, 0},
                                           {0, kRound + 2, 0, 1}};
    const Dependences dependences = dependences_of("array", {"ranges", "offsets_of_ranges"});
    LayoutAccesses sum;
    add_reads(reads, {16, 4}, dependences, sum);
    EXPECT_EQ(sum.chained_reads, 4u);  // An offset and a range of each.
    EXPECT_EQ(sum.longest_chain, 2u);
    EXPECT_EQ(sum.groups, 1u);
    EXPECT_EQ(sum.queries, 2u);
    EXPECT_EQ(sum.reads, 7u);
    EXPECT_EQ(sum.most_reads, 4u);
    EXPECT_EQ(sum.bytes, 4u * 4 + 3 * 16);
    EXPECT_EQ(sum.distinct_bytes, 3u * 4 + 2 * 16);
    EXPECT_EQ(sum.sectors, 2u);
    EXPECT_EQ(sum.lines, 2u);
    EXPECT_EQ(sum.requests, 4u);  // Both of the offsets, the first ranges of both hits, the second of one.
    EXPECT_EQ(sum.request_sectors, 4u);
    EXPECT_EQ(sum.turns, 2u);
    EXPECT_EQ(sum.visits, 3u);

    // A second dispatch, whose hit 33 is another group's: elements 7 and 8 of 16 bytes lie in sectors 3 and 4, lines 0 and 1.
    add_reads(std::vector<LayoutRead>{{33, 0, kQueryBegins, 0}, {33, 0, 0, 7}, {33, 0, 0, 8}}, {16, 4}, dependences, sum);
    EXPECT_EQ(sum.groups, 2u);
    EXPECT_EQ(sum.queries, 3u);
    EXPECT_EQ(sum.sectors, 4u);
    EXPECT_EQ(sum.lines, 4u);
    EXPECT_EQ(sum.requests, 6u);  // One after the other.
}

TEST(AccessesTest, ElementsMayLieAcrossSectors) {
    LayoutAccesses sum;
    add_reads(std::vector<LayoutRead>{{0, 0, 0, 2}, {5, 0, 0, 10}, {6, 0, 0, 10}}, {12}, dependences_of("array", {"ranges"}),
              sum);
    EXPECT_EQ(sum.bytes, 36u);
    EXPECT_EQ(sum.distinct_bytes, 24u);
    EXPECT_EQ(sum.groups, 0u);   // None of their queries begins here.
    EXPECT_EQ(sum.sectors, 4u);  // Bytes 24 to 35, and 120 to 131.
    EXPECT_EQ(sum.lines, 2u);
    EXPECT_EQ(sum.requests, 1u);
    EXPECT_EQ(sum.request_sectors, 4u);
}

class AccessesFrameTest : public TwoCubes<testing::Test> {
protected:
    AccessesFrameTest() : TwoCubes(48, 48, 4) {
        settings.shadow_res = 128;
        settings.count_ranges = true;
    }

    Frame render(const std::string& layout) {
        settings.layout = layout;
        return validated_renderer().render(scene, poses, settings);
    }
};

TEST_F(AccessesFrameTest, AreWhatLayoutsAreKnownToDo) {
    for (const char* method : {"exact", "dtr-analytic"}) {
        SCOPED_TRACE(method);
        settings.method = method;
        settings.count_accesses = 0;
        const Frame expected = render("array");
        EXPECT_FALSE(expected.layout_accesses.has_value());
        settings.count_accesses = 1;
        const uint64_t ranges = expected.stats.counts.at("ranges.0"), queries = expected.stats.counts.at("shadow_tests"),
                       visited = expected.stats.counts.at("ranges_visited");
        const bool exits = settings.method != "exact";
        const uint64_t range_bytes = exits ? 20 : 16, range_reads = exits ? 2 : 1;
        ASSERT_GT(visited, 0u);

        const Frame array = render("array");
        expect_same_bits(array, expected);
        const LayoutAccesses& of_array = array.layout_accesses.value();
        EXPECT_TRUE(of_array.complete);
        EXPECT_EQ(of_array.queries, queries);
        EXPECT_EQ(of_array.visits, visited);
        EXPECT_EQ(of_array.reads, 2 * queries + range_reads * visited);
        EXPECT_EQ(of_array.bytes, 8 * queries + range_bytes * visited);
        EXPECT_EQ(of_array.atomics, 0u);
        EXPECT_EQ(of_array.most_atomics, 0u);
        EXPECT_EQ(of_array.held_bytes, range_bytes * ranges);
        EXPECT_EQ(of_array.used_bytes, of_array.held_bytes);
        EXPECT_LE(of_array.groups, (expected.stats.counts.at("hits") + 31) / 32 + 8);  // Of each batch the last may be partial.
        EXPECT_GE(of_array.turns * 32, visited);
        EXPECT_LE(of_array.distinct_bytes, of_array.bytes);
        EXPECT_LE(of_array.lines, of_array.sectors);
        EXPECT_LE(of_array.sectors, of_array.request_sectors);
        EXPECT_LE(of_array.sectors, 4 * of_array.lines);
        EXPECT_LE(of_array.distinct_bytes, 32 * of_array.sectors);

        const Frame linked = render("linked");
        expect_same_bits(linked, expected);
        const LayoutAccesses& of_linked = linked.layout_accesses.value();
        EXPECT_EQ(of_linked.queries, queries);
        EXPECT_EQ(of_linked.reads, queries + (range_reads + 1) * of_linked.visits);
        EXPECT_EQ(of_linked.atomics, 2 * ranges);
        EXPECT_EQ(of_linked.most_atomics, ranges);  // The counter of nodes.
        EXPECT_GT(of_linked.sectors, of_array.sectors);
        EXPECT_EQ(of_array.longest_chain, 2u);
        EXPECT_LE(of_array.chained_reads, 2 * queries);
        EXPECT_EQ(of_linked.longest_chain, (of_linked.most_reads - 1) / (range_reads + 1) + 2);
        EXPECT_GE(of_linked.chained_reads, queries + of_linked.visits);

        const Frame null = render("null");
        EXPECT_EQ(null.layout_accesses->queries, queries);
        EXPECT_EQ(null.layout_accesses->reads, 0u);
    }
}

TEST_F(AccessesFrameTest, AreThoseOfASample) {
    settings.count_accesses = 1;
    const LayoutAccesses all = render("array").layout_accesses.value();
    settings.count_accesses = 4;
    const LayoutAccesses some = render("array").layout_accesses.value();
    EXPECT_GT(some.groups, all.groups / 8);
    EXPECT_LT(some.groups, all.groups / 2);
    EXPECT_NEAR(double(some.reads) / double(some.queries), double(all.reads) / double(all.queries), 2.0);
    EXPECT_EQ(render("array").layout_accesses->sectors, some.sectors);
}

TEST_F(AccessesFrameTest, OfBitsNoneWaitsForAnotherWord) {
    settings.count_accesses = 1;
    const LayoutAccesses bits = render("bits").layout_accesses.value();
    EXPECT_EQ(bits.longest_chain, 3u);  // Where a tile's triangles begin, a word of bits, a triangle.
    EXPECT_GT(bits.most_reads, 10u);
}

TEST_F(AccessesFrameTest, OfPagesSomeIsSlack) {
    settings.count_accesses = 1;
    const LayoutAccesses paged = render("paged").layout_accesses.value();
    EXPECT_LT(paged.used_bytes, paged.held_bytes);
    EXPECT_GT(paged.used_bytes, 0u);
}

TEST_F(AccessesFrameTest, AreNotThereWithoutAnSBufferNorWhileTheyAreChecked) {
    settings.count_accesses = 1;
    settings.method = "tsm";
    EXPECT_FALSE(render("auto").layout_accesses.has_value());
    settings.method = "exact";
    settings.check_layout = true;
    EXPECT_GNOMON_ERROR(render("array"), ErrorKind::usage, "either checked or counted");
}

}  // namespace
}  // namespace gnomon::test
