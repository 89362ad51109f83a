#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: vertices in world space at one key: morph, then skin.
// Reads:   rest (3 uvec4 per vertex), influences, palette, morph_positions, morph_normals, morph_weights
// Writes:  Positions (xyz, 1), Normals (xyz, 0; not normalised) of the key and the vertices
// Grid:    one invocation per vertex
// Source:  glTF 2.0, 3.7.2.2 and 3.7.3
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/pose.h"

layout(local_size_x = 64) in;
layout(binding = 0) uniform usamplerBuffer rest;
layout(binding = 1) uniform usamplerBuffer influences;
layout(binding = 2) uniform samplerBuffer palette;
layout(binding = 3) uniform samplerBuffer morph_positions;
layout(binding = 4) uniform samplerBuffer morph_normals;
layout(binding = 5) uniform samplerBuffer morph_weights;
layout(binding = 6, scalar) writeonly buffer Positions { vec4 positions[]; };
layout(binding = 7, scalar) writeonly buffer Normals { vec4 normals[]; };
layout(push_constant, scalar) uniform Push { PoseParams params; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= params.vertex_count) return;
    uint v = params.vertex_first + i;
    uvec4 head = texelFetch(rest, int(3u * v));
    uvec4 tail = texelFetch(rest, int(3u * v + 1u));
    uvec4 morph = texelFetch(rest, int(3u * v + 2u));
    vec3 p = uintBitsToFloat(head.xyz);
    vec3 n = uintBitsToFloat(tail.xyz);
    // morph: target count, first delta, deltas from one target to the next, first weight
    for (uint j = 0u; j < morph.x; ++j) {
        float weight = texelFetch(morph_weights, int(morph.w + j)).x;
        int delta = int(morph.y + j * morph.z);
        p = morph_add(p, texelFetch(morph_positions, delta).xyz, weight);
        n = morph_add(n, texelFetch(morph_normals, delta).xyz, weight);
    }
    vec3 position = vec3(0.0);
    vec3 normal = vec3(0.0);
    for (uint j = 0u; j < tail.w; ++j) {
        uvec2 influence = texelFetch(influences, int(head.w + j)).xy;
        int row = int(3u * influence.x);
        float weight = uintBitsToFloat(influence.y);
        vec4 row_x = texelFetch(palette, row);
        vec4 row_y = texelFetch(palette, row + 1);
        vec4 row_z = texelFetch(palette, row + 2);
        position = skin_add(position, row_x, row_y, row_z, p, weight);
        normal = skin_add_normal(normal, row_x, row_y, row_z, n, weight);
    }
    positions[i] = vec4(position, 1.0);
    normals[i] = vec4(normal, 0.0);
}
