// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "sorted-depth": all ranges of a list side by side, nearest first. What is behind the query's limit ends the walk. Ranges with a depth at their exit
// are sorted by the nearer of both. Lists of more than kMostSorted ranges stay as they are, and their walks go on to the end.
// Memory: 16 bytes per range (20 with the depth at its exit), 8 bytes per list (its count and its offset).

float nearest_of(vec4 range, float exit_depth) {
#ifdef GN_RANGE_EXIT
    return min(range.z, exit_depth);
#else
    return range.z;
#endif
}
float sort_key(uint place) { return nearest_of(fetch_ranges(place), fetch_exits(place)); }
void sort_swap(uint a, uint b) {
    vec4 range_a = fetch_ranges(a), range_b = fetch_ranges(b);
    float exit_a = fetch_exits(a), exit_b = fetch_exits(b);
    set_ranges(a, range_b);
    set_ranges(b, range_a);
    set_exits(a, exit_b);
    set_exits(b, exit_a);
}
#include "library/heap_sort.glsl"

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_ranges(cursor, vec4(range.enter, range.leave, range.depth, uintBitsToFloat(range.entry)));
    set_exits(cursor, range.exit_depth);
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
    vec4 range = fetch_ranges(it.x);
    float exit_depth = fetch_exits(it.x);
    bool behind = it.z != 0u && !(nearest_of(range, exit_depth) < query.limit);
    it.x = behind ? it.y : it.x + 1u;
    return Range(range.x, range.y, range.z, floatBitsToUint(range.w), exit_depth);
}
