// SPDX-License-Identifier: Apache-2.0
// Counts to a number in one loop.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Params { uint turns; };
layout(binding = 0, scalar) writeonly buffer Counts { uint counts[]; };

void main() {
    uint count = 0;
    while (count < turns) ++count;
    counts[gl_GlobalInvocationID.x] = count;
}
