#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: first half of an exclusive prefix sum: the sum of each run of kScanRun elements; and the largest element.
// Reads:   values (padded to a multiple of 4 elements with zeros)
// Writes:  Runs (the sum of each run; 0xffffffff where it does not fit), Longest
// Grid:    one invocation per run
// Source:  reduce, then scan; no progress between workgroups is assumed
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "common/saturate.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kLongest = false;  // The values are elements, not sums of them.
layout(binding = 0) uniform usamplerBuffer values;
layout(binding = 1, scalar) writeonly buffer Runs { uint runs[]; };
layout(binding = 2, scalar) buffer Longest { uint longest; };
layout(push_constant, scalar) uniform Push { ScanParams params; };

void main() {
    uint run = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint quad = run * (kScanRun / 4u);
    uint quads = (params.count + 3u) / 4u;
    uint end = min(quad + kScanRun / 4u, quads);
    uint sum = 0u;
    uint largest = 0u;
    while (quad < end) {
        uvec4 v = texelFetch(values, int(quad));
        sum = saturating_add(sum, v.x);
        sum = saturating_add(sum, v.y);
        sum = saturating_add(sum, v.z);
        sum = saturating_add(sum, v.w);
        largest = max(largest, max(max(v.x, v.y), max(v.z, v.w)));
        ++quad;
    }
    if (run * kScanRun < params.count) {
        runs[run] = sum;
        if (kLongest && largest > 0u) atomicMax(longest, largest);
    }
}
