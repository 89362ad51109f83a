// SPDX-License-Identifier: Apache-2.0
// Whole pictures: the same bits in every layout and within every memory budget.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/error.hpp>
#include <gnomon/render.hpp>

#include "layouts/layout.hpp"
#include "support/tested_layouts.hpp"
#include "support/two_cubes.hpp"
#include "unit/io/throws.hpp"

namespace gnomon::test {
namespace {

constexpr uint64_t kMebibyte = 1u << 20;

class PictureTest : public TwoCubes<> {
protected:
    PictureTest() : TwoCubes(96, 64, 8) { settings.shadow_res = 400; }

    static uint64_t fills(const Frame& frame) {
        uint64_t dispatches = 0;
        for (const FrameStats::Stage& stage : frame.stats.stages)
            dispatches += stage.name == "raster/fill" ? stage.dispatches : 0;
        return dispatches;
    }
};

TEST_F(PictureTest, IsTheSameInEveryLayout) {
    const Frame expected = validated_renderer().render(scene, poses, settings);
    for (const std::string& layout : tested_layouts()) {
        // Ranges that only contain the true ones lead to more tests, and the same answers.
        if (!find_layout(layout).lossless && !find_layout(layout).only_contains()) continue;
        SCOPED_TRACE(layout);
        settings.layout = layout;
        expect_same_bits(validated_renderer().render(scene, poses, settings), expected);
    }
}

TEST_F(PictureTest, SaysHowManyRangesWereLost) {
    settings.layout = "array";
    const Frame exact = validated_renderer().render(scene, poses, settings);
    EXPECT_EQ(exact.stats.counts.count("lost.0"), 0u);
    settings.layout = "null";
    const Frame none = validated_renderer().render(scene, poses, settings);
    EXPECT_EQ(none.stats.counts.at("lost.0"), none.stats.counts.at("ranges.0"));
    EXPECT_GT(none.stats.counts.at("lost.0"), 0u);
    settings.method = "dtr-analytic";
    settings.layout = "no-depth";
    EXPECT_GNOMON_ERROR(validated_renderer().render(scene, poses, settings), ErrorKind::usage, "only contains them");
}

TEST_F(PictureTest, IsTheSameWithinAnyBudget) {
    const Frame expected = validated_renderer().render(scene, poses, settings);
    uint64_t most_fills = 0, rendered = 0;
    for (const char* layout : {"array", "linked", "paged", "jagged", "bits"}) {
        settings.layout = layout;
        // Downwards until it does not fit, which is said.
        for (uint64_t budget = 2 * expected.stats.peak_bytes; budget > kMebibyte / 4; budget /= 2) {
            settings.memory_budget = budget;
            try {
                const Frame frame = validated_renderer().render(scene, poses, settings);
                SCOPED_TRACE(testing::Message() << layout << " within " << budget << " bytes");
                EXPECT_LE(frame.stats.peak_bytes, budget);
                expect_same_bits(frame, expected);
                most_fills = std::max(most_fills, fills(frame));
                ++rendered;
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::out_of_memory) << error.what();
                break;
            }
        }
    }
    EXPECT_GT(rendered, 2u);
    EXPECT_GT(most_fills, fills(expected)) << "no budget led to several bands or batches";
}

}  // namespace
}  // namespace gnomon::test
