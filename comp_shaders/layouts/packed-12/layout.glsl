// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "packed-12": 12 bytes a range, a structure of arrays: [enter 16 | leave 16]... [depth 32]... [entry 32]... Times are rounded outward to 65536ths of the
// shutter: a few more triangles are tested, and the answer of a test that asks the triangles is the same.
// Memory: 12 bytes per range, 8 bytes per list (its count and its offset).
#include "library/rounded.glsl"

const float kSteps = 65536.0;

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_times(cursor, enter_step(range.enter, kSteps) | leave_step(range.leave, kSteps) << 16u);
    set_depths(cursor, range.depth);
    set_entries(cursor, range.entry);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    uint times = fetch_times(it.x);
    float depth = fetch_depths(it.x);
    Range range = Range(enter_of(times & 65535u, kSteps), leave_of(times >> 16u, kSteps), depth, fetch_entries(it.x), depth);
    ++it.x;
    return range;
}
