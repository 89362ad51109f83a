#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the box of the vertices that triangles use, at all keys.
// Reads:   triangles, positions
// Writes:  Box (lower and upper corner as ordered bits, math/order.h; whether a position is not finite)
// Grid:    one invocation per kBoundsRun triangles
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/order.h"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(local_size_x = 64) in;
READ_UVEC4(0, triangles)
READ_VEC4(1, positions)
layout(binding = 2, scalar) buffer Box { uvec3 lower; uvec3 upper; uint not_finite; };
layout(push_constant, scalar) uniform Push { BoundsParams params; };

void main() {
    uint run = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uvec3 low = uvec3(0xffffffffu), high = uvec3(0u);
    bool finite = true;
    uint i = min(run * kBoundsRun, params.triangle_count);
    uint end = min(i + kBoundsRun, params.triangle_count);
    while (i < end) {
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
    low = subgroupMin(low);
    high = subgroupMax(high);
    uint broken = subgroupMax(finite ? 0u : 1u);
    if (subgroupElect()) {
        [[unroll]] for (uint axis = 0u; axis < 3u; ++axis) {
            atomicMin(lower[axis], low[axis]);
            atomicMax(upper[axis], high[axis]);
        }
        atomicOr(not_finite, broken);
    }
}
