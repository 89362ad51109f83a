// SPDX-License-Identifier: Apache-2.0
#include "stages/window.hpp"

#include <algorithm>

#include "stages/grid.hpp"

namespace gnomon {

uint32_t tiles_across(const View& view) { return static_cast<uint32_t>(groups_of(view.width, shared::kTileSize)); }
uint32_t tiles_down(const View& view) { return static_cast<uint32_t>(groups_of(view.height, shared::kTileSize)); }

WindowRect rect_of(const View& view, const Window& window) {
    const uint32_t across = tiles_across(view), last = window.tile_first + window.tile_count - 1;
    WindowRect rect;
    rect.first_tile = {window.tile_first % across, window.tile_first / across};
    rect.last_tile = {last % across, last / across};
    rect.first_px = rect.first_tile * shared::kTileSize;
    rect.size_px = glm::min((rect.last_tile + 1u) * shared::kTileSize, glm::uvec2(view.width, view.height)) - rect.first_px;
    return rect;
}

std::vector<Window> windows_of(const View& view, uint64_t most_tiles) {
    const uint32_t across = tiles_across(view), tiles = across * tiles_down(view);
    most_tiles = std::clamp<uint64_t>(most_tiles, 1, tiles);
    const auto step = static_cast<uint32_t>(most_tiles < across ? most_tiles : most_tiles / across * across);
    std::vector<Window> windows;
    for (uint32_t tile = 0; tile < tiles;) {
        const uint32_t row_end = (tile / across + 1) * across;
        const uint32_t end = std::min(tile + step, step < across ? row_end : tiles);
        windows.push_back({tile, end - tile});
        tile = end;
    }
    return windows;
}

bool halve(std::vector<Window>& windows, size_t i, const View& view) {
    const Window window = windows[i];
    if (window.tile_count == 1) return false;
    const uint32_t across = tiles_across(view);
    const uint32_t unit = window.tile_count > across ? across : 1;  // Whole rows stay whole.
    const uint32_t first = (window.tile_count / unit + 1) / 2 * unit;
    windows[i] = {window.tile_first, first};
    windows.insert(windows.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                   {window.tile_first + first, window.tile_count - first});
    return true;
}

}  // namespace gnomon
