#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: a level of each layer's grid: sums of four tuples of the level before.
// Reads:   tuples of the level before
// Writes:  Tuples of the level
// Grid:    one invocation per texel of the level
// Based on: Andersson et al. 2015, "Filtered stochastic shadow mapping using a layered approach", section 5: the filter is widened where there are no samples
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer tuples;
layout(binding = 1, scalar) writeonly buffer Tuples { vec4 written[]; };
layout(push_constant, scalar) uniform Push { FssmMipParams params; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint layer = i >> (2u * params.level_bits);
    if (layer >= params.layer_count) return;
    uint texel = i - (layer << (2u * params.level_bits));
    uint y = texel >> params.level_bits;
    uint x = texel - (y << params.level_bits);
    int from = int(params.read_first + (layer << (2u * params.level_bits + 2u)) + (y << (params.level_bits + 2u)) + 2u * x);
    int below = from + (2 << params.level_bits);
    written[params.write_first + i] = (texelFetch(tuples, from) + texelFetch(tuples, from + 1)) + (texelFetch(tuples, below) + texelFetch(tuples, below + 1));
}
