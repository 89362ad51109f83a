#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the ranges of each texel at its centre: all stays of each triangle over it, with the depths at entry and exit. Count, or fill after the layout's own
//          preparation. Depths are metres along the view's axis. Stays that begin and end behind the eye are none.
// Reads:   bin_offsets, bin_entries, triangles, raster_vertices
// Writes:  RasterCounts (ranges, 64 bits per kCountBlock items), and what the layout says
// Grid:    one workgroup per tile and cell, one invocation per texel
// Source:  math/interval.h
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/interval.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
layout(constant_id = 1) const bool kOrthographic = false;
layout(constant_id = 2) const bool kAsked = false;
layout(constant_id = 3) const bool kResume = false;  // Lists are walked in parts.
READ_UINT(0, bin_offsets)
READ_UINT(1, bin_entries)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
layout(binding = 4, scalar) buffer RasterCounts { uvec2 range_counts[]; };
layout(push_constant, scalar) uniform Push { RasterParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"
#include "common/source_page.glsl"
#include "common/spread.glsl"
#include "common/range_count.glsl"
#define GN_RANGE_EXIT
#include "common/write_lists.glsl"

void main() {
    uint number = spread_first(params.item_count, 1u);
    uint item = params.item_first + min(number, params.item_count - 1u);
    uint texel = gl_LocalInvocationID.x;
    ViewGrid grid = params.grid;
    Page page = fetch_page(item);
    uint cell = page.cell;
    uint column = page.tile_x * kTileSize + (texel & 7u);
    uint row = page.tile_y * kTileSize + (texel >> 3u);
    bool inside = number < params.item_count && column < grid.width && row < grid.height;
    float x = float(column) + 0.5 - 0.5 * float(grid.width);
    float y = float(row) + 0.5 - 0.5 * float(grid.height);
    uint key_first = segment_of_cell(grid, cell) * grid.vertex_stride;
    vec2 span = cell_span(grid, cell);
    float cell_start = float(cell);
    float per_cell = 1.0 / float(grid.cell_count);

    uint k = page.begin + params.list_first;
    uint end = min(page.end, k + kListChunk);
    List list = list_at(item - params.band_first, texel);
    uint count = 0u, cursor = 0u;
    if (kFill && inside) cursor = open_list(list);

    while (k < end) {
        uint entry = fetch_bin_entries(k);
        CellTriangle c = fetch_cell_triangle(grid, entry, key_first, span);
        PointPrism prism = point_prism(c, x, y);
        Stays stays = stays_over(prism);
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            bool stay = inside && stays.enter[j] < stays.leave[j] && (entry & ~kReversed) != page.receiver;
            float enter_depth = metres_at(prism, c, stays.enter[j], kOrthographic);
            float exit_depth = metres_at(prism, c, stays.leave[j], kOrthographic);
            stay = stay && (kOrthographic || enter_depth > 0.0 || exit_depth > 0.0);
            if (stay) {
                if (kFill) {
                    float enter = (cell_start + stays.enter[j]) * per_cell, leave = (cell_start + stays.leave[j]) * per_cell;
                    layout_emit(list, cursor, Range(enter, leave, enter_depth, entry, exit_depth));
                }
                ++count;
            }
        }
        ++k;
    }
    if (!kFill) {
        if (inside) count_ranges(list, count);
        add_range_count(item / kCountBlock, inside ? count : 0u);
    } else if (inside) {
        close_list(list, cursor);
    }
}
