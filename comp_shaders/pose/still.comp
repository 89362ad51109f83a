#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: which triangles stand still: their vertices have the same positions, to the bit, at all keys.
// Reads:   triangles, positions
// Writes:  Still (a bit per triangle, 32 to a word; then their number)
// Grid:    one invocation per triangle
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(local_size_x = 64) in;
READ_UVEC4(0, triangles)
READ_VEC4(1, positions)
layout(binding = 2, scalar) buffer Still { uint still[]; };
layout(push_constant, scalar) uniform Push { BoundsParams params; };

bool same(vec3 a, vec3 b) { return floatBitsToUint(a) == floatBitsToUint(b); }

void main() {
    uint triangle = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = triangle < params.triangle_count;
    uvec3 v = fetch_triangles(inside ? triangle : 0u).xyz;
    vec3 p0 = fetch_positions(v.x).xyz, p1 = fetch_positions(v.y).xyz, p2 = fetch_positions(v.z).xyz;
    bool stands = inside;
    uint key = 1u;
    while (stands && key < params.key_count) {
        uvec3 at = v + key * params.vertex_stride;
        stands = same(p0, fetch_positions(at.x).xyz) && same(p1, fetch_positions(at.y).xyz) && same(p2, fetch_positions(at.z).xyz);
        ++key;
    }
    if (stands) atomicOr(still[triangle >> 5u], 1u << (triangle & 31u));
    uint count = subgroupAdd(stands ? 1u : 0u);
    if (subgroupElect() && count > 0u) atomicAdd(still[(params.triangle_count + 31u) >> 5u], count);
}
