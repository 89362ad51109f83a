#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: for each shell, and for the triangles of none, the box of the vertices that they use, at all keys.
// Reads:   triangles, shells, positions
// Writes:  Boxes (lower and upper corner as ordered bits, math/order.h; whether a position is not finite), one more than there are shells
// Grid:    one invocation per kBoundsRun triangles
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/order.h"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(local_size_x = 64) in;
READ_UVEC4(0, triangles)
READ_VEC4(1, positions)
READ_UINT(2, shells)
struct Box {
    uvec3 lower;
    uvec3 upper;
    uint not_finite;
};
layout(binding = 3, scalar) buffer Boxes { Box boxes[]; };
layout(push_constant, scalar) uniform Push { BoundsParams params; };

void grow(uint shell, uvec3 low, uvec3 high, bool finite) {
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis) {
        atomicMin(boxes[shell].lower[axis], low[axis]);
        atomicMax(boxes[shell].upper[axis], high[axis]);
    }
    if (!finite) atomicOr(boxes[shell].not_finite, 1u);
}

void main() {
    uint run = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uvec3 low = uvec3(0xffffffffu), high = uvec3(0u);
    bool finite = true;
    uint shell = kNone;  // That low and high are of.
    uint i = min(run * kBoundsRun, params.triangle_count);
    uint end = min(i + kBoundsRun, params.triangle_count);
    while (i < end) {
        uint next = fetch_shells(i);
        if (next != shell && shell != kNone) {
            grow(shell, low, high, finite);
            low = uvec3(0xffffffffu);
            high = uvec3(0u);
        }
        shell = next;
        uvec3 vertex = fetch_triangles(i).xyz;
        for (uint key = 0u; key < params.key_count; ++key) {
            [[unroll]] for (uint k = 0u; k < 3u; ++k) {
                vec3 p = fetch_positions(key * params.vertex_stride + vertex[k]).xyz;
                uvec3 place = uvec3(ordered_bits(p.x), ordered_bits(p.y), ordered_bits(p.z));
                low = min(low, place);
                high = max(high, place);
                finite = finite && finite_bits(p.x) && finite_bits(p.y) && finite_bits(p.z);
            }
        }
        ++i;
    }
    // Large shells: one invocation for all that ended in the same one.
    uint first = subgroupMin(shell);
    bool together = subgroupMax(shell == first || shell == kNone ? 0u : 1u) == 0u;
    if (together) {
        low = subgroupMin(low);
        high = subgroupMax(high);
        finite = subgroupMin(finite ? 1u : 0u) == 1u;
        if (subgroupElect() && first != kNone) grow(first, low, high, finite);
    } else if (shell != kNone) {
        grow(shell, low, high, finite);
    }
}
