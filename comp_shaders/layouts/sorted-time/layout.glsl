// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "sorted-time": all ranges of a list side by side, in the order of their entry. What begins after the query's time ends the walk. Lists of
// more than kMostSorted ranges stay as they are, and their walks go on to the end.
// Memory: 16 bytes per range (20 with the depth at its exit), 8 bytes per list (its count and its offset).
#include "library/range_vec4.glsl"

float sort_key(uint place) { return fetch_ranges(place).x; }
#include "library/heap_sort.glsl"

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_range(cursor, range);
    ++cursor;
}
void layout_close(List list, uint cursor) {}
void layout_finish(List list) { heap_sort(first_ranges(list), end_ranges(list)); }

// The next range, the end of the list, and whether it is sorted.
Iterator layout_begin(List list, Query query) {
    uint first = first_ranges(list), end = end_ranges(list);
    return Iterator(first, end, end - first <= kMostSorted && !query.all ? 1u : 0u);
}
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    bool later = it.z != 0u && range.enter > query.t;
    it.x = later ? it.y : it.x + 1u;
    return range;
}
