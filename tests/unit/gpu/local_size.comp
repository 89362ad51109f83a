// SPDX-License-Identifier: Apache-2.0
// A local size of which one axis is a specialization constant, for a test.
#version 460
layout(local_size_x = 4, local_size_y_id = 3, local_size_z = 2) in;
layout(std430, set = 0, binding = 0) buffer Out { uint values[]; };

void main() { values[gl_LocalInvocationIndex] = gl_WorkGroupSize.y; }
