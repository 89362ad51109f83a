#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: exclusive prefix sum of a short array; its total behind it (0xffffffff where a sum does not fit).
// Reads:   values
// Writes:  Sums (count + 1), Longest (the largest element)
// Grid:    one invocation
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "common/saturate.glsl"

layout(local_size_x = 1) in;
layout(constant_id = 0) const bool kLongest = false;  // The values are elements, not sums of them.
layout(binding = 0) uniform usamplerBuffer values;
layout(binding = 1, scalar) writeonly buffer Sums { uint sums[]; };
layout(binding = 2, scalar) buffer Longest { uint longest; };
layout(push_constant, scalar) uniform Push { ScanParams params; };

void main() {
    uint sum = 0u;
    uint largest = 0u;
    uint i = 0u;
    while (i < params.count) {
        uint value = texelFetch(values, int(i)).x;
        sums[i] = sum;
        largest = max(largest, value);
        sum = saturating_add(sum, value);
        ++i;
    }
    sums[params.count] = sum;
    if (kLongest) longest = largest;
}
