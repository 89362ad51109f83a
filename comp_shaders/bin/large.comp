#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: list large prisms in those tiles of their bounds that they can touch. Count, or fill after the scan.
// Reads:   blocks, rects (of all cells), triangles, raster_vertices
// Writes:  Lists (count: entries per list; fill: the next free place of each list), Entries (fill)
// Grid:    kBlockTiles invocations per block, a tile each in every round
// Source:  math/range.h, with the tile as the box
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/rect.h"
#include "math/orientation.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
layout(constant_id = 1) const bool kByBounds = false;  // Each prism once, in every tile of its bounds.
layout(constant_id = 2) const bool kApart = false;     // As in bin/small.
READ_UVEC2(0, blocks)
READ_UVEC2(1, rects)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
layout(binding = 4, scalar) buffer Lists { uint lists[]; };
layout(binding = 5, scalar) writeonly buffer Entries { uint entries[]; };
layout(push_constant, scalar) uniform Push { BinParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"

void main() {
    uint number = group_index() * (gl_WorkGroupSize.x / kBlockTiles) + gl_LocalInvocationID.x / kBlockTiles;
    if (number >= params.block_count) return;
    ViewGrid grid = params.grid;
    uvec2 block = fetch_blocks(number);
    uint triangle = block.x;
    uint cell = block.y >> 20u;
    Rect rect = unpack_rect(fetch_rects(cell * params.rect_stride + triangle - params.triangle_first));
    uint tile_lists = grid.cell_count + (kApart ? 1u : 0u);
    uint columns = rect.last.x - rect.first.x + 1u;
    uint rounds = rect_rounds(rect.first, rect.last);

    uint key_first = segment_of_cell(grid, cell) * grid.vertex_stride;
    CellTriangle c = fetch_cell_triangle(grid, triangle, key_first, cell_span(grid, cell));
    const float kReach = 0.5 * float(kTileSize);
    float extent = grid_extent(grid);
    float slack = time_slack(grid.cell_count);
    uint tile = (block.y & 0xfffffu) * kBlockTiles * rounds + gl_LocalInvocationID.x % kBlockTiles;
    uint end = tile + kBlockTiles * rounds;
    do {
        uint row = tile / columns;
        uvec2 t = uvec2(rect.first.x + (tile - row * columns), rect.first.y + row);
        bool inside = t.y <= rect.last.y;
        vec2 centre = tile_centre(grid, t.x, t.y);
        vec3 a0 = tile_relative(c.a0, centre.x, centre.y), a1 = tile_relative(c.a1, centre.x, centre.y), a2 = tile_relative(c.a2, centre.x, centre.y);
        vec3 b0 = tile_relative(c.b0, centre.x, centre.y), b1 = tile_relative(c.b1, centre.x, centre.y), b2 = tile_relative(c.b2, centre.x, centre.y);
        bool positive = inside && (kByBounds || ((rect.seen & kSeenPositive) != 0u && touches_tile(a0, a1, a2, b0, b1, b2, kReach, extent, slack)));
        bool negative = inside && !kByBounds && (rect.seen & kSeenNegative) != 0u && touches_tile(a0, a2, a1, b0, b2, b1, kReach, extent, slack);

        uint copies = (positive ? 1u : 0u) + (negative ? 1u : 0u);
        if (copies > 0u) {
            uint place = atomicAdd(lists[(t.y * grid.tiles_x + t.x - grid.tile_first) * tile_lists + cell], copies);
            if (kFill) {
                entries[place] = triangle | (positive ? 0u : kReversed);
                if (copies == 2u) entries[place + 1u] = triangle | kReversed;
            }
        }
        tile += kBlockTiles;
    } while (tile < end);
}
