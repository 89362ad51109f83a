// SPDX-License-Identifier: Apache-2.0
// The ranges of every list through a layout's reading functions: how many, or copied one list behind the other. Needs: common/stage.glsl, and GN_RANGE_EXIT where
// ranges have a depth at their exit

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kCopy = false;
layout(constant_id = 1) const bool kResume = false;  // Lists are walked in parts of kListChunk.
layout(binding = 0, scalar) buffer Places { uint places[]; };  // Of each list: how many ranges it has; kCopy: where its next one goes.
layout(binding = 1, scalar) writeonly buffer Found { ListRange found[]; };
layout(push_constant, scalar) uniform Push { ReadListsParams params; };
#define LAYOUT_READ
#include "common/s_buffer.glsl"
layout(binding = 2, scalar) buffer Iterators { Iterator iterators[]; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = i < params.list_count;
    i = min(i, params.list_count - 1u);
    uint number = params.list_first + i;
    Query query = Query(0.0, kFarthest, true);
    Iterator it = layout_begin(list_at(number / kTileTexels, number % kTileTexels), query);
    if (kResume && params.part > 0u) it = iterators[i];
    uint place = places[i];
    uint walked = 0u;
    bool more = inside && layout_more(it);
    while (more) {
        Range range = layout_next(it, query);
#ifndef GN_RANGE_EXIT
        range.exit_depth = range.depth;
#endif
        if (kCopy) found[place] = ListRange(range.enter, range.leave, range.depth, range.exit_depth, range.entry);
        ++place;
        ++walked;
        more = layout_more(it) && walked < kListChunk;
    }
    if (kResume && inside) iterators[i] = it;
    if (inside) places[i] = place;
}
