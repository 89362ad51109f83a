#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: which items become pages: those that somebody asked for and where a prism is listed that may shadow him.
// Reads:   receivers, bin_offsets, bin_entries
// Writes:  Marks (1 or 0)
// Grid:    one invocation per item
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
READ_UVEC2(0, receivers)
READ_UINT(1, bin_offsets)
READ_UINT(2, bin_entries)
layout(binding = 3, scalar) writeonly buffer Marks { uint marks[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };

// Lists that may hold the receivers' own triangle alone: in both orientations.
const uint kShortList = 2u;

void main() {
    uint item = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (item >= params.node_first) return;
    uvec2 receiver = fetch_receivers(item);
    uint begin = fetch_bin_offsets(item);
    uint end = fetch_bin_offsets(item + 1u);
    bool others = end - begin > kShortList;
    uint last = min(end, begin + kShortList);
    for (uint i = begin; i < last; ++i) others = others || (fetch_bin_entries(i) & ~kReversed) + 1u != receiver.y;
    marks[item] = receiver.x != 0u && others ? 1u : 0u;
}
