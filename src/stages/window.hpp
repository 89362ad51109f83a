// SPDX-License-Identifier: Apache-2.0
// Windows: the parts of a view whose lists are in memory at one time. A view that is small enough is one window.
#pragma once

#include <utility>
#include <vector>

#include "views/view.hpp"

namespace gnomon {

/// A run of a view's tiles, in rows from the top: whole rows, or a part of one row, so that it is a rectangle.
struct Window {
    uint32_t tile_first = 0;
    uint32_t tile_count = 0;

    bool operator==(const Window&) const = default;
};

/// A window in tiles and in pixels.
struct WindowRect {
    glm::uvec2 first_tile{0};  ///< Column and row.
    glm::uvec2 last_tile{0};
    glm::uvec2 first_px{0};
    glm::uvec2 size_px{0};
};

uint32_t tiles_across(const View& view);
uint32_t tiles_down(const View& view);
WindowRect rect_of(const View& view, const Window& window);

/// Windows that cover the view, in order, of at most `most_tiles` tiles each.
std::vector<Window> windows_of(const View& view, uint64_t most_tiles);

/// Replace windows[i] by its two halves. False where it is a single tile.
bool halve(std::vector<Window>& windows, size_t i, const View& view);

}  // namespace gnomon
