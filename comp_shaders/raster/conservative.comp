#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the ranges of each texel, conservative: every time at which a triangle may cover any point of the texel lies in its range, and its nearest depth is not
//          behind the triangle anywhere. Count, or fill after the layout's own preparation.
// Reads:   bin_offsets, bin_entries, triangles, raster_vertices, pages, page_entries
// Writes:  RasterCounts (ranges, 64 bits per kCountBlock items), and what the layout says
// Grid:    8 invocations per tile and cell: one per column of texels, the counts of its 8 rows in registers; they prepare the list's prisms for each other
// Source:  math/texel_range.h
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/texel_range.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
layout(constant_id = 1) const bool kOrthographic = false;
layout(constant_id = 2) const uint kCrew = 8u;
layout(constant_id = 3) const bool kAsked = false;
layout(constant_id = 4) const bool kResume = false;  // Lists are walked in parts.
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
#include "common/crew.glsl"
#include "common/write_lists.glsl"

EdgeBound shown(EdgeBound e, uint from) { return EdgeBound(subgroupShuffle(e.start, from), subgroupShuffle(e.end, from)); }

TileBounds shown(TileBounds t, uint from) { return TileBounds(shown(t.e0, from), shown(t.e1, from), shown(t.e2, from)); }

const float kReach = 0.5 * float(kTileSize);

void main() {
    Crew crew = join_crew();
    uint item = params.item_first + spread_first(params.item_count, 8u) + (crewed_invocation() >> 3u);
    uint lane = crewed_invocation() & 7u;
    bool inside = item < params.item_first + params.item_count;
    item = min(item, params.item_first + params.item_count - 1u);
    Page page = fetch_page(item);
    ViewGrid grid = page.grid;
    float scale = page_scale(page);
    uint cell = page.cell;
    vec2 centre = tile_centre(grid, page.tile_x, page.tile_y);
    float x = float(lane) - 3.5;
    float extent = grid_extent(grid);
    uint key_first = segment_of_cell(grid, cell) * grid.vertex_stride;
    vec2 span = cell_span(grid, cell);
    float slack = time_slack(grid.cell_count);
    float cell_start = float(cell);
    float per_cell = 1.0 / float(grid.cell_count);

    emitted_cell = vec2(cell_start, cell_start + 1.0) * per_cell;
    uint begin = page.begin + params.list_first;
    uint end = max(page.end, begin);
    uint entries = inside ? min(end - begin, kListChunk) : 0u;
    uint rounds = rounds_of(entries);

    // Lists of this column's texels; texels outside the image get no ranges.
    uint tile = item - params.band_first;
    uint rows = inside && page.tile_x * kTileSize + lane < grid.width ? min(grid.height - page.tile_y * kTileSize, kTileSize) : 0u;

    uint cursors[8];  // Or counts.
    [[unroll]] for (uint r = 0u; r < 8u; ++r) cursors[r] = 0u;
    if (kFill) {
        [[unroll]] for (uint r = 0u; r < 8u; ++r) {
            if (r < rows) cursors[r] = open_list(list_at(tile, r * kTileSize + lane));
        }
    }

    uint k = 0u;
    while (k < rounds) {
        // Past the end: any entry, which then is not listed.
        uint own_entry = fetch_page_entry(k + crew.place < entries ? begin + k + crew.place : 0u);
        CellTriangle c = fetch_cell_triangle(grid, own_entry, key_first, span, scale);
        TileBounds own_bounds = tile_bounds(c, centre.x, centre.y, kReach, extent);
        uvec2 own_rows = tile_rows(c, centre.y, kReach, extent, slack);
        float own_nearest = nearest_depth(c, kOrthographic);
        uint from = 0u;
        uint last = min(crew.size, rounds - k);
        do {
            uint source = crew.first + from;
            uint entry = subgroupShuffle(own_entry, source);
            float nearest = subgroupShuffle(own_nearest, source);
            ColumnBounds column = column_bounds(shown(own_bounds, source), x);
            uint row = subgroupShuffle(own_rows.x, source);
            uint last_row = subgroupShuffle(own_rows.y, source);
            bool listed = k + from < entries && nearest < page.limit && (entry & ~kReversed) != page.receiver;
            while (listed && row <= last_row) {
                vec3 times = texel_times(column, float(row) - 3.5);
                bool hit = touches_texel(times, slack) && row < rows;
                if (kFill) {
                    uint cursor = 0u;
                    [[unroll]] for (uint r = 0u; r < 8u; ++r) cursor = r == row ? cursors[r] : cursor;
                    if (hit) {
                        emitted_triangle = params.list_first + k + from;
                        vec2 span_of = range_times(times, cell_start, per_cell, slack);
                        layout_emit(list_at(tile, row * kTileSize + lane), cursor, Range(span_of.x, span_of.y, nearest, entry, nearest));
                    }
                    [[unroll]] for (uint r = 0u; r < 8u; ++r) cursors[r] = r == row ? cursor : cursors[r];
                } else {
                    [[unroll]] for (uint r = 0u; r < 8u; ++r) cursors[r] += r == row && hit ? 1u : 0u;
                }
                ++row;
            }
            ++from;
        } while (from < last);
        k += crew.size;
    }
    if (!kFill) {
        uint sum = 0u;
        [[unroll]] for (uint r = 0u; r < 8u; ++r) {
            if (r < rows) count_ranges(list_at(tile, r * kTileSize + lane), cursors[r]);
            sum += cursors[r];
        }
        add_range_count(item / kCountBlock, inside ? sum : 0u);
    } else {
        [[unroll]] for (uint r = 0u; r < 8u; ++r) {
            if (r < rows) close_list(list_at(tile, r * kTileSize + lane), cursors[r]);
        }
    }
}
