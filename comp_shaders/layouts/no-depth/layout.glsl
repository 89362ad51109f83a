// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "no-depth": 8 bytes a range, side by side: [enter 16 | leave 16 | entry 32]. Times are rounded outward, and ranges are as near as can be: more triangles are
// tested, and the answer of a test that asks the triangles is the same.
// Memory: 8 bytes per range, 8 bytes per list (its count and its offset).

const float kSteps = 65535.0;

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    uint enter = uint(clamp(floor(range.enter * kSteps), 0.0, kSteps)), leave = uint(clamp(ceil(range.leave * kSteps), 0.0, kSteps));
    // The way back is rounded.
    enter -= enter > 0u && float(enter) / kSteps > range.enter ? 1u : 0u;
    leave += leave < 65535u && float(leave) / kSteps < range.leave ? 1u : 0u;
    set_ranges(cursor, uvec2(enter | leave << 16u, range.entry));
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    uvec2 range = fetch_ranges(it.x);
    ++it.x;
    return Range(float(range.x & 65535u) / kSteps, float(range.x >> 16u) / kSteps, -kFarthest, range.y, -kFarthest);
}
