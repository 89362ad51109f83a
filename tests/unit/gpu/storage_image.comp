// SPDX-License-Identifier: Apache-2.0
// A resource that is not supported, for a test.
#version 460
layout(local_size_x = 8) in;
layout(set = 0, binding = 0, r32f) uniform image2D picture;

void main() { imageStore(picture, ivec2(gl_LocalInvocationIndex, 0), vec4(1)); }
