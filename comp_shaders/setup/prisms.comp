#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: for each prism in one cell of time: the tiles of the window that it may touch and the orientations in which it may be seen.
//          kCasting: only those in which it may shadow something. kSampled: of small ones only the tiles with samples that they may cover.
// Reads:   triangles, raster_vertices, shells, closed, positions, still
// Writes:  Rects of the cell (shared/rect.h), BlockCounts (blocks that bin/large will need, by parts of the triangles)
// Grid:    one invocation per triangle
// Source:  bounds of a linear motion are those of its ends, since x / w is monotone in time for w > 0
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/rect.h"
#include "math/texel_range.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCasting = false;
layout(constant_id = 1) const uint kPart = kWholeScene;
layout(constant_id = 2) const bool kSampled = false;
READ_UVEC4(0, triangles)
READ_VEC4(1, raster_vertices)
READ_UINT(4, shells)
READ_UINT(5, closed)
READ_VEC4(6, positions)
READ_UINT(7, still)
layout(binding = 2, scalar) writeonly buffer Rects { uvec2 rects[]; };
layout(binding = 3, scalar) buffer BlockCounts { uint block_counts[]; };
layout(push_constant, scalar) uniform Push { PrismParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"
#include "common/casting.glsl"
#include "common/sampled.glsl"

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= params.triangle_count) return;
    uint triangle = params.triangle_first + i;
    ViewGrid grid = params.grid;
    uint segment = segment_of_cell(grid, params.cell);
    MovingTriangle m = fetch_moving_triangle(triangle, segment * grid.vertex_stride, grid.vertex_stride);
    vec2 span = cell_span(grid, params.cell);
    CellTriangle c = cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, span.x, span.y);

    float highest_w = max(max_of(c.a0.w, c.a1.w, c.a2.w), max_of(c.b0.w, c.b1.w, c.b2.w));
    bool in_front = cell_in_front(c);
    float extent = grid_extent(grid);
    uint seen = prism_orientations(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, c, extent);
    if (kCasting) seen = casting(triangle, seen);
    if (!in_part(triangle)) seen = 0u;

    CellBox box = cell_box(c, extent, time_slack(grid.cell_count));
    vec2 half_size = 0.5 * vec2(float(grid.width), float(grid.height));
    vec2 window_first = vec2(params.window_first), window_last = vec2(params.window_last);
    vec2 first = in_front ? floor((box.lower + half_size) * (1.0 / float(kTileSize))) : window_first;
    vec2 last = in_front ? floor((box.upper + half_size) * (1.0 / float(kTileSize))) : window_last;
    if (kSampled && seen != 0u) {
        MetPixels met = met_pixels(m, grid, params.cell);
        if (met.known) {
            first = vec2(met.first / kTileSize);
            last = vec2(met.last / kTileSize);
            if (met.first.x > met.last.x) seen = 0u;
        }
    }
    // The last tiles may reach beyond the image.
    bool beside = !in_front && beside_image(c, half_size + float(kTileSize), time_slack(grid.cell_count));
    bool visible = seen != 0u && highest_w > 0.0 && !beside && first.x <= window_last.x && first.y <= window_last.y && last.x >= window_first.x && last.y >= window_first.y;
    uvec2 f = uvec2(clamp(first, window_first, window_last));
    uvec2 l = uvec2(clamp(last, window_first, window_last));
    vec2 view_last = vec2((uvec2(grid.width, grid.height) + kTileSize - 1u) / kTileSize - 1u);
    bool large = rect_is_large(uvec2(clamp(first, vec2(0.0), view_last)), uvec2(clamp(last, vec2(0.0), view_last)), in_front);

    rects[i] = pack_rect(f, l, visible ? seen : 0u, large);
    uint blocks = visible && large ? rect_blocks(f, l) : 0u;
    if (blocks > 0u) atomicAdd(block_counts[params.part_first + (i >> params.part_log2)], blocks);
}
