// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array-counter": all ranges of a list side by side. A list takes its places from one counter, before it is filled: no prefix sum, but lists lie in
// the order of arrival, and each costs an atomic at one address.
// Based on: Vasilakis and Fudos 2012, "S-buffer: Sparsity-aware multi-fragment rendering", section 3
// Memory: 16 bytes per range (20 with the depth at its exit), 12 bytes per list (its count, twice, and its place).
#include "library/range_vec4.glsl"

uint layout_size_places(List list, uint count) { return count; }
void layout_prepare(List list) {
    uint count = size_ranges(list);
    if (count > 0u) set_firsts(list.index, allocate_places(count));
}

uint layout_open(List list) { return fetch_firsts(list.index); }
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
