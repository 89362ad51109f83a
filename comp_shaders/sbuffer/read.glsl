// SPDX-License-Identifier: Apache-2.0
// The ranges of every list through a layout's reading functions: how many, or copied one list behind the other. Needs: common/stage.glsl, and GN_RANGE_EXIT where
// ranges have a depth at their exit

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCopy = false;
layout(constant_id = 1) const bool kResume = false;  // Lists are walked in parts of kListChunk.
layout(binding = 0, scalar) buffer Places { uint places[]; };  // Of each list: how many ranges it has; kCopy: where its next one goes.
layout(binding = 1, scalar) writeonly buffer Found { ListRange found[]; };
layout(binding = 2, scalar) buffer Iterators { uvec2 iterators[]; };
layout(push_constant, scalar) uniform Push { ReadListsParams params; };
uint range_base() { return params.range_first; }
#define ListIterator uvec2
#define LAYOUT_READ
#include "layout.glsl"

ListRange next_range(inout ListIterator it) {
    ListRange result;
#ifdef GN_RANGE_EXIT
    result.exit_depth = layout_exit_depth(it);
#endif
    vec4 range = layout_next(it);
    result.enter = range.x;
    result.leave = range.y;
    result.depth = range.z;
    result.entry = floatBitsToUint(range.w);
#ifndef GN_RANGE_EXIT
    result.exit_depth = range.z;
#endif
    return result;
}

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = i < params.list_count;
    i = min(i, params.list_count - 1u);
    ListIterator it = layout_begin(params.list_first + i);
    if (kResume && params.part > 0u) it = iterators[i];
    uint place = places[i];
    uint walked = 0u;
    bool more = inside && layout_more(it);
    while (more) {
        ListRange range = next_range(it);
        if (kCopy) found[place] = range;
        ++place;
        ++walked;
        more = layout_more(it) && walked < kListChunk;
    }
    if (kResume && inside) iterators[i] = it;
    if (inside) places[i] = place;
}
