// SPDX-License-Identifier: Apache-2.0
// Each workgroup below the count adds one to its own element, those past it to the element behind, for a test.
#version 460
layout(local_size_x = 8) in;
layout(std430, set = 0, binding = 0) buffer Visits { uint visits[]; };
layout(push_constant) uniform Params { uint count; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (gl_LocalInvocationIndex == 0) atomicAdd(visits[min(group, count)], 1u);
}
