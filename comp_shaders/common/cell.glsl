// SPDX-License-Identifier: Apache-2.0
// A prism within one cell of time. Needs common/triangle.glsl.

// Vertices at the cell's start (a) and end (b).
struct CellTriangle {
    vec4 a0, a1, a2;
    vec4 b0, b1, b2;
};

uint segment_of_cell(ViewGrid grid, uint cell) { return cell / (grid.cell_count / grid.segment_count); }

// Local times in the cell's segment at which the cell starts and ends.
vec2 cell_span(ViewGrid grid, uint cell) {
    uint per_segment = grid.cell_count / grid.segment_count;
    uint first = cell - segment_of_cell(grid, cell) * per_segment;
    return vec2(float(first), float(first + 1u)) / float(per_segment);
}

CellTriangle fetch_cell_triangle(ViewGrid grid, uint entry, uint key_first, vec2 span) {
    MovingTriangle m = fetch_moving_triangle(entry, key_first, grid.vertex_stride);
    CellTriangle c;
    c.a0 = vertex_at(m.a0, m.d0, span.x);
    c.a1 = vertex_at(m.a1, m.d1, span.x);
    c.a2 = vertex_at(m.a2, m.d2, span.x);
    c.b0 = vertex_at(m.a0, m.d0, span.y);
    c.b1 = vertex_at(m.a1, m.d1, span.y);
    c.b2 = vertex_at(m.a2, m.d2, span.y);
    return c;
}

// The largest absolute raster coordinate of a view's image.
float grid_extent(ViewGrid grid) { return 0.5 * float(max(grid.width, grid.height)); }

// A tile's centre in raster space.
vec2 tile_centre(ViewGrid grid, uint tile_x, uint tile_y) {
    return vec2(float(tile_x * kTileSize + kTileSize / 2u) - 0.5 * float(grid.width),
                float(tile_y * kTileSize + kTileSize / 2u) - 0.5 * float(grid.height));
}
