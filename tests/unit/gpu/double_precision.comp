// SPDX-License-Identifier: Apache-2.0
// Uses a feature that gnomon does not enable, for a test of the validation layer.
#version 460
layout(local_size_x = 8) in;
layout(std430, set = 0, binding = 0) buffer Values { double values[]; };

void main() { values[gl_LocalInvocationIndex] *= 2.0; }
