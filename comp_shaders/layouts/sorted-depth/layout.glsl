// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "sorted-depth": all ranges of a list side by side, nearest first. What is behind the query's limit ends the walk. Ranges with a depth at their exit
// are sorted by the nearer of both. Lists of more than kMostSorted ranges stay as they are, and their walks go on to the end.
// Memory: 16 bytes per range (20 with the depth at its exit), 8 bytes per list (its count and its offset).
#include "library/range_vec4.glsl"

float nearest_of(Range range) {
#ifdef GN_RANGE_EXIT
    return min(range.depth, range.exit_depth);
#else
    return range.depth;
#endif
}
float sort_key(uint place) { return nearest_of(fetch_range(place)); }
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
    bool behind = it.z != 0u && !(nearest_of(range) < query.limit);
    it.x = behind ? it.y : it.x + 1u;
    return range;
}
