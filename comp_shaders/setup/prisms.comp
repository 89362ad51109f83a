#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: for each prism in one cell of time: the tiles of the window that it may touch and the orientations in which it may be seen.
//          kCasting: only what may shadow something. Of closed shells the orientation that looks away is enough; what stands still on the scene's hull shadows
//          nothing while the eye is on the scene's side of it.
// Reads:   triangles, raster_vertices, shells, closed, positions
// Writes:  Rects of the cell (shared/rect.h), BlockCounts (blocks that bin/large will need, by parts of the triangles)
// Grid:    one invocation per triangle
// Source:  bounds of a linear motion are those of its ends, since x / w is monotone in time for w > 0
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/rect.h"
#include "math/texel_range.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCasting = false;
READ_UVEC4(0, triangles)
READ_VEC4(1, raster_vertices)
READ_UINT(4, shells)
READ_UINT(5, closed)
READ_VEC4(6, positions)
layout(binding = 2, scalar) writeonly buffer Rects { uvec2 rects[]; };
layout(binding = 3, scalar) buffer BlockCounts { uint block_counts[]; };
layout(push_constant, scalar) uniform Push { PrismParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"

// The orientation in which the eye sees a triangle from the side on which the whole scene lies; 0 where it lies on both, or the triangle moves.
uint hull_orientation(uint triangle, uint key_first) {
    uvec3 v = fetch_triangles(triangle).xyz + key_first;
    vec3 p0 = fetch_positions(v.x).xyz, p1 = fetch_positions(v.y).xyz, p2 = fetch_positions(v.z).xyz;
    uvec3 next = v + params.grid.vertex_stride;
    bool still = p0 == fetch_positions(next.x).xyz && p1 == fetch_positions(next.y).xyz && p2 == fetch_positions(next.z).xyz;
    vec3 n = cross3(p1 - p0, p2 - p0);
    vec3 a = n * (params.box_lower - p0), b = n * (params.box_upper - p0);
    vec3 low = min(a, b), high = max(a, b);
    uint orientation = low.x + low.y + low.z >= 0.0 ? kSeenNegative : (high.x + high.y + high.z <= 0.0 ? kSeenPositive : 0u);
    return still ? orientation : 0u;
}

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
    if (kCasting) {
        bool closed = fetch_closed(fetch_shells(triangle)) != 0u;
        seen &= closed ? kSeenAway : ~hull_orientation(triangle, segment * grid.vertex_stride);
    }

    CellBox box = cell_box(c, extent, time_slack(grid.cell_count));
    vec2 half_size = 0.5 * vec2(float(grid.width), float(grid.height));
    vec2 window_first = vec2(params.window_first), window_last = vec2(params.window_last);
    vec2 first = in_front ? floor((box.lower + half_size) * (1.0 / float(kTileSize))) : window_first;
    vec2 last = in_front ? floor((box.upper + half_size) * (1.0 / float(kTileSize))) : window_last;
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
