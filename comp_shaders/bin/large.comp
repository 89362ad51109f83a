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
layout(binding = 0) uniform usamplerBuffer blocks;
layout(binding = 1) uniform usamplerBuffer rects;
layout(binding = 2) uniform usamplerBuffer triangles;
layout(binding = 3) uniform samplerBuffer raster_vertices;
layout(binding = 4, scalar) buffer Lists { uint lists[]; };
layout(binding = 5, scalar) writeonly buffer Entries { uint entries[]; };
layout(push_constant, scalar) uniform Push { BinParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"

// Can the triangle, in this orientation, touch the tile that the vertices are relative to?
bool touches_tile(vec3 a0, vec3 a1, vec3 a2, vec3 b0, vec3 b1, vec3 b2, float extent) {
    const float reach = 0.5 * float(kTileSize);
    BoundScale scale = bound_scale(a0, a1, a2, b0, b1, b2, reach, reach, extent);
    EdgeBound e0 = edge_bound(a1, a2, b1, b2, scale, reach);
    EdgeBound e1 = edge_bound(a2, a0, b2, b0, scale, reach);
    EdgeBound e2 = edge_bound(a0, a1, b0, b1, scale, reach);
    float lo = 0.0, hi = 1.0, highest = 0.0;
    clip_to_bound(e0.start.z, e0.end.z, lo, hi, highest);
    clip_to_bound(e1.start.z, e1.end.z, lo, hi, highest);
    clip_to_bound(e2.start.z, e2.end.z, lo, hi, highest);
    float slack = time_slack(params.grid.cell_count);
    return highest >= 0.0 && lo - slack <= hi + slack;
}

void main() {
    uint number = group_index() * (gl_WorkGroupSize.x / kBlockTiles) + gl_LocalInvocationID.x / kBlockTiles;
    if (number >= params.block_count) return;
    ViewGrid grid = params.grid;
    uvec2 block = texelFetch(blocks, int(number)).xy;
    uint triangle = block.x;
    uint cell = block.y >> 20u;
    Rect rect = unpack_rect(texelFetch(rects, int(cell * params.rect_stride + triangle - params.triangle_first)).xy);
    uint columns = rect.last.x - rect.first.x + 1u;
    uint rounds = rect_rounds(rect.first, rect.last);

    uint key_first = segment_of_cell(grid, cell) * grid.vertex_stride;
    CellTriangle c = fetch_cell_triangle(grid, triangle, key_first, cell_span(grid, cell));
    float extent = grid_extent(grid);
    uint tile = (block.y & 0xfffffu) * kBlockTiles * rounds + gl_LocalInvocationID.x % kBlockTiles;
    uint end = tile + kBlockTiles * rounds;
    do {
        uint row = tile / columns;
        uvec2 t = uvec2(rect.first.x + (tile - row * columns), rect.first.y + row);
        bool inside = t.y <= rect.last.y;
        vec2 centre = tile_centre(grid, t.x, t.y);
        vec3 a0 = tile_relative(c.a0, centre.x, centre.y), a1 = tile_relative(c.a1, centre.x, centre.y), a2 = tile_relative(c.a2, centre.x, centre.y);
        vec3 b0 = tile_relative(c.b0, centre.x, centre.y), b1 = tile_relative(c.b1, centre.x, centre.y), b2 = tile_relative(c.b2, centre.x, centre.y);
        bool positive = inside && (kByBounds || ((rect.seen & kSeenPositive) != 0u && touches_tile(a0, a1, a2, b0, b1, b2, extent)));
        bool negative = inside && !kByBounds && (rect.seen & kSeenNegative) != 0u && touches_tile(a0, a2, a1, b0, b2, b1, extent);

        uint copies = (positive ? 1u : 0u) + (negative ? 1u : 0u);
        if (copies > 0u) {
            uint place = atomicAdd(lists[(t.y * grid.tiles_x + t.x - grid.tile_first) * grid.cell_count + cell], copies);
            if (kFill) {
                entries[place] = triangle | (positive ? 0u : kReversed);
                if (copies == 2u) entries[place + 1u] = triangle | kReversed;
            }
        }
        tile += kBlockTiles;
    } while (tile < end);
}
