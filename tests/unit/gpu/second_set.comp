// SPDX-License-Identifier: Apache-2.0
// A resource outside descriptor set 0, for a test.
#version 460
layout(local_size_x = 8) in;
layout(std430, set = 1, binding = 0) buffer Values { uint values[]; };

void main() { values[gl_LocalInvocationIndex] = 1; }
