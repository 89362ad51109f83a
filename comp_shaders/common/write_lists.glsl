// SPDX-License-Identifier: Apache-2.0
// The two passes of a raster stage over the lists of an S-buffer. Each list is one invocation's, in each of the dispatches that walk its source in parts.
// Needs: RasterParams params, kResume
#define LAYOUT_WRITE
#include "common/s_buffer.glsl"
layout(binding = 16, scalar) buffer ListState { uint list_state[]; };  // Per list: its count so far; in the fill pass, between dispatches, its cursor.

uint place_in_part(List list) { return list.index - part_first_tile() * kTileTexels; }

// So many ranges more.
void count_ranges(List list, uint count) {
#ifdef LAYOUT_COUNTS
    uint i = place_in_part(list);
    list_state[i] = count + (kResume && params.list_first > 0u ? list_state[i] : 0u);
#endif
}

uint open_list(List list) {
    uint cursor = 0u;
    if (kResume && params.list_first > 0u) {
        cursor = list_state[place_in_part(list)];
    } else {
        cursor = layout_open(list);
    }
    return cursor;
}

void close_list(List list, uint cursor) {
    if (kResume && params.last == 0u) {
        list_state[place_in_part(list)] = cursor;
    } else {
        layout_close(list, cursor);
    }
}
