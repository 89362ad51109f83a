// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "no-depth": 8 bytes a range, side by side: [enter 16 | leave 16 | entry 32]. Times are rounded outward, and ranges are as near as can be: more triangles are
// tested, and the answer of a test that asks the triangles is the same.
// Memory: 8 bytes per range, 8 bytes per list (its count and its offset).
#include "library/rounded.glsl"

const float kSteps = 65536.0;

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_ranges(cursor, uvec2(enter_step(range.enter, kSteps) | leave_step(range.leave, kSteps) << 16u, range.entry));
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    uvec2 range = fetch_ranges(it.x);
    ++it.x;
    return Range(enter_of(range.x & 65535u, kSteps), leave_of(range.x >> 16u, kSteps), -kFarthest, range.y, -kFarthest);
}
