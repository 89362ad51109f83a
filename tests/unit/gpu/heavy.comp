// SPDX-License-Identifier: Apache-2.0
// Each workgroup below the count works for a while, then adds its result to its own element, for a test.
#version 460
layout(local_size_x = 8) in;
layout(std430, set = 0, binding = 0) buffer Results { uint results[]; };
layout(push_constant) uniform Params {
    uint count;
    uint steps;
};

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (group >= count) return;
    uint state = group + gl_LocalInvocationIndex;
    for (uint i = 0; i < steps; ++i) state = state * 1664525u + 1013904223u;
    atomicAdd(results[group], state);
}
