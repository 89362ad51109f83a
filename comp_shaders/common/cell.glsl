// SPDX-License-Identifier: Apache-2.0
// A prism within one cell of time. Behind the last cell comes one that lasts as long as the shutter, for what stands still.
// Needs common/triangle.glsl.

#include "math/texel_range.h"

uint segment_of_cell(ViewGrid grid, uint cell) { return cell == grid.cell_count ? 0u : cell / (grid.cell_count / grid.segment_count); }

// Local times in the cell's segment at which the cell starts and ends.
vec2 cell_span(ViewGrid grid, uint cell) {
    if (cell == grid.cell_count) return vec2(0.0, 1.0);
    uint per_segment = grid.cell_count / grid.segment_count;
    uint first = cell - segment_of_cell(grid, cell) * per_segment;
    return vec2(float(first), float(first + 1u)) / float(per_segment);
}

// With `scale` texels, a power of two, to a texel of the view.
CellTriangle fetch_cell_triangle(ViewGrid grid, uint entry, uint key_first, vec2 span, float scale) {
    MovingTriangle m = scaled(fetch_moving_triangle(entry, key_first, grid.vertex_stride), scale);
    return cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, span.x, span.y);
}

CellTriangle fetch_cell_triangle(ViewGrid grid, uint entry, uint key_first, vec2 span) {
    MovingTriangle m = fetch_moving_triangle(entry, key_first, grid.vertex_stride);
    return cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, span.x, span.y);
}

// The largest absolute raster coordinate of a view's image.
float grid_extent(ViewGrid grid) { return 0.5 * float(max(grid.width, grid.height)); }

// A tile's centre in raster space.
vec2 tile_centre(ViewGrid grid, uint tile_x, uint tile_y) {
    return vec2(float(tile_x * kTileSize + kTileSize / 2u) - 0.5 * float(grid.width),
                float(tile_y * kTileSize + kTileSize / 2u) - 0.5 * float(grid.height));
}
