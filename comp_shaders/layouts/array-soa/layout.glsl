// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array-soa": all ranges of a list side by side, a structure of arrays: [enter leave]... [depth]... [entry]...
// Memory: 16 bytes per range (20 with the depth at its exit), 8 bytes per list (its count and its offset).

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_times(cursor, vec2(range.enter, range.leave));
    set_depths(cursor, range.depth);
    set_entries(cursor, range.entry);
    set_exits(cursor, range.exit_depth);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(first_ranges(list), end_ranges(list)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    vec2 times = fetch_times(it.x);
    Range range = Range(times.x, times.y, fetch_depths(it.x), fetch_entries(it.x), fetch_exits(it.x));
    ++it.x;
    return range;
}
