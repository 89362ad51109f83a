// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array-morton": as array; the lists of a tile lie in Morton order, so that neighbours in both directions are near each other.
// Memory: 16 bytes per range (20 with the depth at its exit), 8 bytes per list (its count and its offset).

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_ranges(cursor, vec4(range.enter, range.leave, range.depth, uintBitsToFloat(range.entry)));
    set_exits(cursor, range.exit_depth);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    vec4 range = fetch_ranges(it.x);
    float exit_depth = fetch_exits(it.x);
    ++it.x;
    return Range(range.x, range.y, range.z, floatBitsToUint(range.w), exit_depth);
}
