#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the ranges of every list through a layout's reading functions: how many, or copied one list behind the other.
// Reads:   what the layout says
// Writes:  Counts (per list; the second time read: where the list's copy starts), Found
// Grid:    one invocation per list
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "read_ranges.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCopy = false;
layout(binding = 0, scalar) buffer Counts { uint counts[]; };
layout(binding = 1, scalar) writeonly buffer Found { vec4 found[]; };
layout(push_constant, scalar) uniform Push { ReadRangesParams params; };
uint range_base() { return params.range_first; }
#define ListIterator uvec2
#define LAYOUT_READ
#include "layout.glsl"

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = i < params.list_count;
    i = min(i, params.list_count - 1u);
    ListIterator it = layout_begin(params.list_first + i);
    uint place = kCopy ? counts[i] : 0u;
    bool more = inside && layout_more(it);
    while (more) {
        vec4 range = layout_next(it);
        if (kCopy) found[place] = range;
        ++place;
        more = layout_more(it);
    }
    if (!kCopy && inside) counts[i] = place;
}
