#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the edge functions of triangles as the device computes them.
// Reads:   Corners (three vertices, then (x, y, 0, 0), for each query)
// Writes:  Edges
// Grid:    one invocation per query
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/cover.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Corners { vec4 corners[]; };
layout(binding = 1, scalar) writeonly buffer Edges { vec3 edges[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= count) return;
    vec4 point = corners[4u * i + 3u];
    edges[i] = edges_at(corners[4u * i], corners[4u * i + 1u], corners[4u * i + 2u], point.x, point.y);
}
