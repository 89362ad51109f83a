// SPDX-License-Identifier: Apache-2.0
// The pages of an S-buffer: 8 x 8 texels of a light's view in one cell of time, with the prisms that are listed there. All items of the window, or, with kAsked, those that
// receivers asked for (pages/list). Needs: kAsked, params.grid, pages, bin_offsets

struct Page {
    uint tile_x;
    uint tile_y;
    uint cell;
    uint begin;     // Entries [begin, end).
    uint end;
    uint receiver;  // The triangle that all who asked lie on, which shadows none of them; kNone: there are several.
    float limit;    // What is not nearer shadows none of them.
};

Page fetch_page(uint number) {
    uvec4 asked = kAsked ? fetch_pages(number) : uvec4(number, kNone, 0x7f800000u, 0u);
    uint tile_in_window = asked.x / params.grid.cell_count;
    uint tile = params.grid.tile_first + tile_in_window;
    Page page;
    page.tile_y = tile / params.grid.tiles_x;
    page.tile_x = tile - page.tile_y * params.grid.tiles_x;
    page.cell = asked.x - tile_in_window * params.grid.cell_count;
    page.begin = fetch_bin_offsets(asked.x);
    page.end = fetch_bin_offsets(asked.x + 1u);
    page.receiver = asked.y;
    page.limit = uintBitsToFloat(asked.z);
    return page;
}
