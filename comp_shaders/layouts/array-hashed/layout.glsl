// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array-hashed": all ranges of a list side by side, and lists in 32 regions one behind the other:
//     [region 0: list | list | ...] [region 1: list | ...] ... [region 31: ...]
// Which region is a hash of the list. A list takes its places within it from the region's own counter, so that neighbours do not wait for one counter; where regions
// begin is known when all lists have taken theirs: the sum of the counters before.
// Based on: Vasilakis and Fudos 2012, "S-buffer: Sparsity-aware multi-fragment rendering", section 3, without its filling of half the regions from the other end
// Memory: 16 bytes per range (20 with the depth at its exit), 12 bytes per list (its count, twice, and its place), 128 bytes of counters.
#include "library/range_vec4.glsl"

uint region_of(List list) { return list.index % COUNTERS; }

// Within the region.
void layout_prepare(List list) {
    uint count = size_ranges(list);
    if (count > 0u) set_firsts(list.index, add_counters(region_of(list), count));
}

uint layout_open(List list) {
    uint first = 0u;
    if (size_ranges(list) > 0u) {
        first = fetch_firsts(list.index);
        for (uint region = 0u; region < region_of(list); ++region) first += fetch_counters(region);
        set_firsts(list.index, first);
    }
    return first;
}
void layout_emit(List list, inout uint cursor, Range range) {
    set_range(cursor, range);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and how many are left.
Iterator layout_begin(List list, Query query) { return Iterator(fetch_firsts(list.index), size_ranges(list)); }
bool layout_more(Iterator it) { return it.y > 0u; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    ++it.x;
    --it.y;
    return range;
}
