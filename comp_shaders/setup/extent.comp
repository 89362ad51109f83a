#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: where in an orthographic view lies what may shadow something, at each key, and how many triangles that is.
// Reads:   triangles, raster_vertices, shells, closed, positions, still
// Writes:  Extents (per key: lower and upper corner, raster units as ordered bits, math/order.h; triangles of the segment that begins with it)
// Grid:    one invocation per kBoundsRun triangles
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/order.h"
#include "math/texel_range.h"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kPart = kWholeScene;
READ_UVEC4(0, triangles)
READ_VEC4(1, raster_vertices)
READ_UINT(2, shells)
READ_UINT(3, closed)
READ_VEC4(4, positions)
READ_UINT(6, still)
struct Extent {
    uvec2 lower;
    uvec2 upper;
    uint count;
};
layout(binding = 5, scalar) buffer Extents { Extent extents[]; };
layout(push_constant, scalar) uniform Push { ExtentParams params; };
#include "common/triangle.glsl"
#include "common/cell.glsl"
#include "common/casting.glsl"

void grow(uint key, vec2 lower, vec2 upper) {
    lower = subgroupMin(lower);
    upper = subgroupMax(upper);
    if (subgroupElect() && lower.x <= upper.x) {
        atomicMin(extents[key].lower.x, ordered_bits(lower.x));
        atomicMin(extents[key].lower.y, ordered_bits(lower.y));
        atomicMax(extents[key].upper.x, ordered_bits(upper.x));
        atomicMax(extents[key].upper.y, ordered_bits(upper.y));
    }
}

void main() {
    ViewGrid grid = params.grid;
    uint first = (group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x) * kBoundsRun;
    uint segment = 0u;
    do {
        uint key_first = segment * grid.vertex_stride;
        vec2 lower = vec2(kFarthest), upper = vec2(-kFarthest), next_lower = lower, next_upper = upper;
        uint i = 0u, count = 0u;
        do {
            uint triangle = min(first + i, grid.triangle_count - 1u);
            MovingTriangle m = fetch_moving_triangle(triangle, key_first, grid.vertex_stride);
            CellTriangle c = cell_triangle(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, 0.0, 1.0);
            uint seen = prism_orientations(m.a0, m.a1, m.a2, m.d0, m.d1, m.d2, c, grid_extent(grid));
            if (first + i < grid.triangle_count && in_part(triangle) && casting(triangle, seen) != 0u) {
                ++count;
                lower = min(lower, min(c.a0.xy, min(c.a1.xy, c.a2.xy)));
                upper = max(upper, max(c.a0.xy, max(c.a1.xy, c.a2.xy)));
                next_lower = min(next_lower, min(c.b0.xy, min(c.b1.xy, c.b2.xy)));
                next_upper = max(next_upper, max(c.b0.xy, max(c.b1.xy, c.b2.xy)));
            }
            ++i;
        } while (i < kBoundsRun);
        count = subgroupAdd(count);
        if (subgroupElect() && count > 0u) atomicAdd(extents[segment].count, count);
        grow(segment, lower, upper);
        grow(segment + 1u, next_lower, next_upper);
        ++segment;
    } while (segment < grid.segment_count);
}
