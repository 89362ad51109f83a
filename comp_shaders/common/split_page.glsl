// SPDX-License-Identifier: Apache-2.0
// What is handed down to the four pages that one is split into. Needs: params.grid, triangles, raster_vertices
#include "common/triangle.glsl"
#include "common/cell.glsl"
#include "common/page.glsl"

MovingTriangle fetch_entry_triangle(Page page, uint entry) {
    return fetch_moving_triangle(entry, segment_of_cell(page.grid, page.cell) * page.grid.vertex_stride, page.grid.vertex_stride);
}

// The prism in the page's cell of time, in the raster space of its level.
CellTriangle in_cell(Page page, MovingTriangle m) {
    vec2 span = cell_span(page.grid, page.cell);
    m = scaled(m, page_scale(page));
    return cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, span.x, span.y);
}

bool touches(Page page, CellTriangle c) {
    vec2 centre = tile_centre(page.grid, page.tile_x, page.tile_y);
    return cell_touches_tile(c, centre.x, centre.y, 0.5 * float(kTileSize), grid_extent(page.grid), time_slack(page.grid.cell_count));
}
