// SPDX-License-Identifier: Apache-2.0
// Windows cover their view once, are rectangles, and halve until they are single tiles.
#include "stages/window.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

View view_of(uint32_t width, uint32_t height) {
    View view;
    view.width = width;
    view.height = height;
    return view;
}

void expect_cover(const View& view, const std::vector<Window>& windows) {
    uint32_t next = 0, pixels = 0;
    for (const Window& window : windows) {
        ASSERT_EQ(window.tile_first, next);
        ASSERT_GT(window.tile_count, 0u);
        next += window.tile_count;
        const WindowRect rect = rect_of(view, window);
        const glm::uvec2 tiles = rect.last_tile - rect.first_tile + 1u;
        ASSERT_EQ(tiles.x * tiles.y, window.tile_count) << "a rectangle";
        ASSERT_EQ(rect.first_px, rect.first_tile * 8u);
        pixels += rect.size_px.x * rect.size_px.y;
    }
    EXPECT_EQ(next, tiles_across(view) * tiles_down(view));
    EXPECT_EQ(pixels, view.width * view.height);
}

TEST(Windows, CoverTheView) {
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(8, 9), glm::uvec2(65, 17), glm::uvec2(300, 200)}) {
        const View view = view_of(size.x, size.y);
        for (const uint64_t most : {0u, 1u, 2u, 5u, 9u, 38u, 39u, 100u, 1000000u}) {
            const std::vector<Window> windows = windows_of(view, most);
            expect_cover(view, windows);
            for (const Window& window : windows) EXPECT_LE(window.tile_count, std::max<uint64_t>(1, most));
        }
    }
    EXPECT_EQ(windows_of(view_of(1280, 720), 14400).size(), 1u);
}

TEST(Windows, AreHalvedUntilTheyAreTiles) {
    const View view = view_of(70, 41);  // 9 x 6 tiles
    std::vector<Window> windows = windows_of(view, 1000);
    ASSERT_TRUE(halve(windows, 0, view));
    EXPECT_THAT(windows, testing::ElementsAre(Window{0, 27}, Window{27, 27}));
    ASSERT_TRUE(halve(windows, 1, view));
    EXPECT_THAT(windows, testing::ElementsAre(Window{0, 27}, Window{27, 18}, Window{45, 9}));
    ASSERT_TRUE(halve(windows, 2, view));
    EXPECT_THAT(windows, testing::ElementsAre(Window{0, 27}, Window{27, 18}, Window{45, 5}, Window{50, 4}));
    for (size_t i = 0; i < windows.size();) i += halve(windows, i, view) ? 0 : 1;
    EXPECT_EQ(windows.size(), 54u);
    expect_cover(view, windows);
}

}  // namespace
}  // namespace gnomon::test
