// SPDX-License-Identifier: Apache-2.0
// The oracle of filtered stochastic shadow maps on numbers worked out by hand.
#include "oracle/fssm.hpp"

#include <gmock/gmock.h>

namespace gnomon::oracle {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FssmOracle, LayersStartBehindTheLongestGaps) {
    // Gaps of 3 (1 to 5), 1 (5 to 7), 5 (8 to 14) and 1 (14 to 16) intervals.
    const std::vector<int> occupied = {0, 1, 5, 7, 8, 14, 16};
    EXPECT_THAT(layer_starts(occupied, 1), IsEmpty());
    EXPECT_THAT(layer_starts(occupied, 2), ElementsAre(14));
    EXPECT_THAT(layer_starts(occupied, 3), ElementsAre(5, 14));
    EXPECT_THAT(layer_starts(occupied, 4), ElementsAre(5, 7, 14));
    EXPECT_THAT(layer_starts({0, 1, 2}, 4), IsEmpty());
}

// One sample moves by (3, 4) texels, whose length is 5: u along (0.6, 0.8), s_u = 16 / 21, s_v = 1.
TEST(FssmOracle, GridFollowsTheMotion) {
    const FssmTile tile({{glm::dvec2(4.0, 4.0), 0.5, 2.0, glm::dvec3(3.0, 4.0, 1.0)}}, glm::dvec2(4.0, 4.0), {});
    ASSERT_EQ(tile.layers().size(), 1u);
    const FssmLayer& layer = tile.layers()[0];
    EXPECT_EQ(layer.motion, glm::dvec3(3.0, 4.0, 1.0));
    // 5 texels along u at t = 1/2; 2.5 from there by t = 1.
    const glm::dvec2 p = tile.on_grid(layer, glm::dvec2(7.0, 8.0), 0.5), q = tile.on_grid(layer, glm::dvec2(7.0, 8.0), 1.0);
    EXPECT_NEAR(p.x, 8.0 + 5.0 * 16.0 / 21.0, 1e-12);
    EXPECT_NEAR(p.y, 8.0, 1e-12);
    EXPECT_NEAR(q.x, 8.0 + 2.5 * 16.0 / 21.0, 1e-12);
    // Across: v is 90 degrees further than u.
    EXPECT_NEAR(tile.on_grid(layer, glm::dvec2(4.0 - 0.8, 4.0 + 0.6), 0.5).y, 9.0, 1e-12);
    EXPECT_EQ(layer.tuples[8 * 16 + 8], glm::dvec4(2.0, 4.0, 1.0, 1.0));
}

TEST(FssmOracle, OpacityIsTheShareOfSamplesInTheLayer) {
    // At one place: an occluder at depth 1, floor at 5 three times, nothing twice.
    std::vector<MapSample> samples(6, MapSample{glm::dvec2(4.2, 4.2), 0.5, 5.0});
    samples[0].depth = 1.0;
    samples[4].hit = samples[5].hit = false;
    const FssmTile tile(samples, glm::dvec2(4.0, 4.0), {});
    ASSERT_EQ(tile.layers().size(), 2u);
    EXPECT_EQ(tile.layers()[0].tuples[8 * 16 + 8], glm::dvec4(1.0, 1.0, 1.0, 6.0));
    EXPECT_EQ(tile.layers()[1].tuples[8 * 16 + 8], glm::dvec4(15.0, 75.0, 3.0, 5.0));
    const glm::dvec2 at(4.5, 4.5);  // The texel's centre.
    EXPECT_NEAR(tile.visibility({at, at, 0.5, 0.5, 4.9, 0.5}), 5.0 / 6.0, 1e-12);
    EXPECT_NEAR(tile.visibility({at, at, 0.5, 0.5, 6.0, 0.5}), 5.0 / 6.0 * 2.0 / 5.0, 1e-12);
    // Three texels off there are no samples: the filter is widened until there are.
    const glm::dvec2 off(7.5, 4.5);
    EXPECT_NEAR(tile.visibility({off, off, 0.5, 0.5, 4.9, 0.5}), 5.0 / 6.0, 1e-12);
}

TEST(FssmOracle, VarianceBoundsTheLight) {
    // Depths 1 and 3: mean 2, variance 1. At 4: 1 / (1 + 4).
    EXPECT_DOUBLE_EQ(visibility_through(glm::dvec4(4.0, 10.0, 2.0, 2.0), 4.0), 0.2);
    EXPECT_DOUBLE_EQ(visibility_through(glm::dvec4(4.0, 10.0, 2.0, 4.0), 4.0), 1.0 - 0.5 * 0.8);
    EXPECT_DOUBLE_EQ(visibility_through(glm::dvec4(4.0, 10.0, 2.0, 2.0), 1.9), 1.0);
    EXPECT_DOUBLE_EQ(visibility_through(glm::dvec4(0.0), 1.9), 1.0);
}

}  // namespace
}  // namespace gnomon::oracle
