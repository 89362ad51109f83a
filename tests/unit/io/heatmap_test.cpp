// SPDX-License-Identifier: Apache-2.0
// Heat maps: colours follow the numbers, and the scale is beside them.
#include "io/heatmap.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::io {
namespace {

using Colour = std::array<uint8_t, 3>;

Colour at(const Heatmap& map, uint32_t x, uint32_t y) {
    const size_t first = (size_t(y) * map.width + x) * 3;
    return {map.rgb.at(first), map.rgb.at(first + 1), map.rgb.at(first + 2)};
}

/// CIE 1976 L*, of which equal steps look equal.
double lightness(const Colour& c) {
    const auto linear = [](uint8_t v) {
        const double s = v / 255.0;
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    return 116.0 * std::cbrt(0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2])) - 16.0;
}

// Matplotlib's table at 0, 0.5 and 1 is (68, 1, 84), (33, 145, 140), (253, 231, 37).
TEST(Viridis, IsNearItsTableAndGetsLighterEvenly) {
    const Colour expected[] = {{68, 1, 84}, {33, 145, 140}, {253, 231, 37}};
    for (size_t i = 0; i < 3; ++i) {
        const Colour found = viridis(0.5 * static_cast<double>(i));
        for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[i][c], 5);
    }
    for (int i = 0; i < 20; ++i) {
        const double step = lightness(viridis((i + 1) / 20.0)) - lightness(viridis(i / 20.0));
        EXPECT_GT(step, 2.0) << i;
        EXPECT_LT(step, 6.0) << i;
    }
}

TEST(Heatmap, ColoursFollowTheLogarithm) {
    const std::vector<uint32_t> counts = {0, 1, 4, 16, 0, 0, 2, 8};
    const Heatmap map = heatmap(counts, 4);
    EXPECT_EQ(map.rgb.size(), size_t(map.width) * map.height * 3);
    EXPECT_EQ(at(map, 0, 0), (Colour{0, 0, 0}));
    EXPECT_EQ(at(map, 1, 0), viridis(0.0));
    EXPECT_EQ(at(map, 2, 0), viridis(0.5));
    EXPECT_EQ(at(map, 3, 0), viridis(1.0));
    EXPECT_EQ(at(map, 2, 1), viridis(0.25));
    EXPECT_EQ(at(map, 3, 1), viridis(0.75));
    EXPECT_EQ(at(map, 0, 2), (Colour{255, 255, 255}));  // Below the map.
    // Its scale has both ends, and is longer than such a map.
    EXPECT_GT(map.width, 40u);
    EXPECT_GE(map.height, 100u);
    size_t least = 0, most = 0;
    for (uint32_t y = 0; y < map.height; ++y) {
        for (uint32_t x = 8; x < map.width; ++x) {
            least += at(map, x, y) == viridis(0.0) ? 1 : 0;
            most += at(map, x, y) == viridis(1.0) ? 1 : 0;
        }
    }
    EXPECT_GT(least, 10u);
    EXPECT_GT(most, 10u);
}

TEST(Heatmap, OfNothingAndOfTheMostThereCanBe) {
    const Heatmap nothing = heatmap(std::vector<uint32_t>(300 * 200), 300);
    EXPECT_EQ(nothing.height, 200u);
    EXPECT_EQ(at(nothing, 299, 199), (Colour{0, 0, 0}));
    const Heatmap full = heatmap(std::vector<uint32_t>{4294967295u, 1}, 2);
    EXPECT_EQ(at(full, 0, 0), viridis(1.0));
    EXPECT_EQ(at(heatmap(std::vector<uint32_t>{1}, 1), 0, 0), viridis(1.0));
}

}  // namespace
}  // namespace gnomon::io
