// SPDX-License-Identifier: Apache-2.0
// Every way to read, beside a block that is written and one that only seems to be readonly, for a test.
#version 460
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) uniform usamplerBuffer texels;
layout(std430, set = 0, binding = 1) readonly buffer Input {
    uint first;
    uint rest[];
};
layout(std140, set = 0, binding = 2) uniform Settings { uint addend; };
layout(std430, set = 0, binding = 3) buffer Mixed {
    readonly uint head;
    uint tail[];
};
layout(std430, set = 0, binding = 4) writeonly buffer Sums { uint sums[]; };

void main() {
    uint i = gl_LocalInvocationIndex;
    tail[i] = head;
    sums[i] = texelFetch(texels, int(i)).x + first + rest[0] + addend;
}
