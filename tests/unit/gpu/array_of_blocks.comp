// SPDX-License-Identifier: Apache-2.0
// An array of descriptors, which is not supported, for a test.
#version 460
layout(local_size_x = 8) in;
layout(std430, set = 0, binding = 0) buffer Values { uint values[]; } blocks[2];

void main() { blocks[1].values[gl_LocalInvocationIndex] = 1; }
