#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: second half of an exclusive prefix sum: each run from the sum of all runs before it. The total goes behind the last element.
// Reads:   values, runs (scanned)
// Writes:  Sums (count + 1; 0xffffffff where a sum does not fit)
// Grid:    one invocation per run
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "common/saturate.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform usamplerBuffer values;
layout(binding = 1) uniform usamplerBuffer runs;
layout(binding = 2, scalar) writeonly buffer Sums { uint sums[]; };
layout(push_constant, scalar) uniform Push { ScanParams params; };

void main() {
    uint number = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint run = params.run_first + number;
    uint bound_first = params.run_first * kScanRun;
    uint first = run * kScanRun;
    uint end = number < params.run_count ? min(first + kScanRun, params.count) : first;
    uint sum = texelFetch(runs, int(run)).x;
    uint i = first;
    while (i < end) {
        uvec4 v = texelFetch(values, int(i / 4u));
        uvec4 before;
        before.x = sum;
        before.y = saturating_add(before.x, v.x);
        before.z = saturating_add(before.y, v.y);
        before.w = saturating_add(before.z, v.z);
        [[unroll]] for (uint j = 0u; j < 4u; ++j) {
            if (i + j < end) sums[i + j - bound_first] = before[j];
        }
        sum = saturating_add(before.w, v.w);
        i += 4u;
    }
    if (first < params.count && end == params.count) sums[params.count - bound_first] = sum;
}
