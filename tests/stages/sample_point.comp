#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: samples as the device computes them.
// Reads:   Queries (pixel x, pixel y, stratum, bits of the strata\'s length)
// Writes:  Points
// Grid:    one invocation per query
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/sample.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Queries { uvec4 queries[]; };
layout(binding = 1, scalar) writeonly buffer Points { vec3 points[]; };
layout(push_constant, scalar) uniform Push { uint seed; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uvec4 q = queries[i];
    points[i] = sample_point(pixel_hash(q.x, q.y, seed), q.x, q.y, q.z, uintBitsToFloat(q.w));
}
