#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: how many of each run of kScanRun slots hit something.
// Reads:   hits
// Writes:  Runs
// Grid:    one invocation per run
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
READ_UVEC4(0, hits)
layout(binding = 1, scalar) writeonly buffer Runs { uint runs[]; };
layout(push_constant, scalar) uniform Push { CompactParams params; };

void main() {
    uint run = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (run >= params.run_count) return;
    uint count = 0u;
    uint quad = run * (kScanRun / 4u);
    uint end = quad + kScanRun / 4u;
    do {
        uvec4 h = fetch_hits(quad);
        count += (h.x != kNone ? 1u : 0u) + (h.y != kNone ? 1u : 0u) + (h.z != kNone ? 1u : 0u) + (h.w != kNone ? 1u : 0u);
        ++quad;
    } while (quad < end);
    runs[run] = count;
}
