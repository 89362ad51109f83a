// SPDX-License-Identifier: Apache-2.0
// Which of the four parts that a page is split into a prism of its list lies in. Needs: params.grid, triangles, raster_vertices
#include "common/triangle.glsl"
#include "common/cell.glsl"
#include "common/page.glsl"

MovingTriangle fetch_entry_triangle(Page page, uint entry) {
    return fetch_moving_triangle(entry, segment_of_cell(page.grid, page.cell) * page.grid.vertex_stride, page.grid.vertex_stride);
}

// Bits of those that may be touched by the prism c of the page's cell, in the raster space of the page's level: by its bounds, and where those are not small by its
// edges, too.
uint parts_in_space(Page page, CellTriangle c) {
    const float reach = 0.25 * float(kTileSize);
    float extent = grid_extent(page.grid);
    float slack = time_slack(page.grid.cell_count);
    vec2 centre = tile_centre(page.grid, page.tile_x, page.tile_y);
    uint parts = 0xfu;
    bool small = false;
    if (cell_in_front(c)) {
        CellBox box = cell_box(c, extent, slack);
        bvec2 low = lessThanEqual(box.lower, centre), high = greaterThanEqual(box.upper, centre);
        bool apart = any(greaterThan(box.lower, centre + 2.0 * reach)) || any(lessThan(box.upper, centre - 2.0 * reach));
        uint columns = (low.x ? 0x5u : 0u) | (high.x ? 0xau : 0u), rows = (low.y ? 0x3u : 0u) | (high.y ? 0xcu : 0u);
        parts = apart ? 0u : columns & rows;
        small = all(lessThan(box.upper - box.lower, vec2(reach)));
    }
    uint left = small || bitCount(parts) < 2 ? 0u : parts;
    while (left != 0u) {
        uint q = uint(findLSB(left));
        vec2 at = centre + reach * (2.0 * vec2(float(q & 1u), float(q >> 1u)) - 1.0);
        bool touched = touches_tile(tile_relative(c.a0, at.x, at.y), tile_relative(c.a1, at.x, at.y), tile_relative(c.a2, at.x, at.y), tile_relative(c.b0, at.x, at.y),
                                    tile_relative(c.b1, at.x, at.y), tile_relative(c.b2, at.x, at.y), reach, extent, slack);
        parts = touched ? parts : parts & ~(1u << q);
        left &= left - 1u;
    }
    return parts;
}

CellTriangle in_cell(Page page, MovingTriangle m) {
    vec2 span = cell_span(page.grid, page.cell);
    m = scaled(m, page_scale(page));
    return cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, span.x, span.y);
}

uint parts_in_time(Page page, MovingTriangle m) {
    vec2 centre = tile_centre(page.grid, page.tile_x, page.tile_y);
    uint parts = 0u;
    for (uint q = 0u; q < 4u; ++q) {
        Page part = part_of(page, kSplitTime, q);
        bool touched = cell_touches_tile(in_cell(part, m), centre.x, centre.y, 0.5 * float(kTileSize), grid_extent(page.grid), time_slack(part.grid.cell_count));
        parts |= touched ? 1u << q : 0u;
    }
    return parts;
}
