// SPDX-License-Identifier: Apache-2.0
// The pages of an S-buffer: 8 x 8 texels of a light's view in one cell of time, with the prisms that are listed there. All items of the window, or those that
// receivers asked for (pages/list) and those that they were split into (pages/adopt): at level l their texels have a 2^l-th of the view's texels' side, at time
// level m their cells last a 4^m-th of the view's. A page of a level is a tile of a view of that many texels and cells. Needs: params.grid
#include "math/order.h"

struct Page {
    ViewGrid grid;    // The view at the page's levels.
    uint tile_x;
    uint tile_y;
    uint cell;
    uint level;
    uint time_level;
    uint split;       // How it was split: its list is empty then. 0: not.
    uint begin;       // Entries [begin, end).
    uint end;
    uint receiver;    // The triangle that all who asked lie on, which shadows none of them; kNone: there are several.
    float limit;      // What is not nearer shadows none of them.
};

ViewGrid grid_at(ViewGrid grid, uint level, uint time_level) {
    grid.width <<= level;
    grid.height <<= level;
    grid.cell_count <<= 2u * time_level;
    return grid;
}

// Texels of its level to a texel of the view.
float page_scale(Page page) { return float(1u << page.level); }

Page item_page(ViewGrid grid, uint item, uint begin, uint end) {
    Page page;
    page.grid = grid;
    uint tile_in_window = item / grid.cell_count;
    uint tile = grid.tile_first + tile_in_window;
    page.tile_y = tile / grid.tiles_x;
    page.tile_x = tile - page.tile_y * grid.tiles_x;
    page.cell = item - tile_in_window * grid.cell_count;
    page.level = 0u;
    page.time_level = 0u;
    page.split = 0u;
    page.begin = begin;
    page.end = end;
    page.receiver = kNone;
    page.limit = uintBitsToFloat(0x7f800000u);
    return page;
}

// For those who asked (common/ask.glsl).
void set_receiver(inout Page page, uvec2 receiver) {
    page.receiver = receiver.y == kNone ? kNone : receiver.y - 1u;
    page.limit = from_ordered_bits(receiver.x);
}

// As two elements of the buffer.
uvec4 page_place(Page page) { return uvec4(page.tile_x | page.level << 24u, page.tile_y | page.time_level << 24u, page.cell, page.receiver); }
uvec4 page_list(Page page) { return uvec4(page.begin, page.end, floatBitsToUint(page.limit), page.split); }

Page unpack_page(ViewGrid grid, uvec4 place, uvec4 list) {
    Page page;
    page.level = place.x >> 24u;
    page.time_level = place.y >> 24u;
    page.grid = grid_at(grid, page.level, page.time_level);
    page.tile_x = place.x & 0xffffffu;
    page.tile_y = place.y & 0xffffffu;
    page.cell = place.z;
    page.receiver = place.w;
    page.begin = list.x;
    page.end = list.y;
    page.limit = uintBitsToFloat(list.z);
    page.split = list.w;
    return page;
}

// Part `q` of a page that is split in this way; its list is still the page's.
Page part_of(Page page, uint split, uint q) {
    Page part = page;
    part.split = 0u;
    if (split == kSplitSpace) {
        part.tile_x = 2u * page.tile_x + (q & 1u);
        part.tile_y = 2u * page.tile_y + (q >> 1u);
        part.level = page.level + 1u;
    } else {
        part.cell = 4u * page.cell + q;
        part.time_level = page.time_level + 1u;
    }
    part.grid = grid_at(params.grid, part.level, part.time_level);
    return part;
}
