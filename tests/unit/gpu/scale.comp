// SPDX-License-Identifier: Apache-2.0
// scaled[i] = values[i] * factor + kAddend, for a test.
#version 460
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kAddend = 5;
layout(set = 0, binding = 0) uniform samplerBuffer values;
layout(std430, set = 0, binding = 1) writeonly buffer Scaled { float scaled[]; };
layout(push_constant) uniform Params {
    uint count;
    float factor;
};

void main() {
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    if (i < count) scaled[i] = texelFetch(values, int(i)).x * factor + float(kAddend);
}
