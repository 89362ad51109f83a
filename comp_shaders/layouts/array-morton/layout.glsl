// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array-morton": as array; the lists of a tile lie in Morton order, so that neighbours in both directions are near each other.
// Memory: 16 bytes per range (20 with the depth at its exit), 8 bytes per list (its count and its offset).
#include "library/range_vec4.glsl"

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_range(cursor, range);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    ++it.x;
    return range;
}
