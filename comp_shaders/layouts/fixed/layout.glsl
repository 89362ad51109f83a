// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "fixed": K ranges for each list, in the order of arrival. No count of the ranges is needed; what is beyond K is lost, and counted.
// Based on: Bavoil et al. 2007, "Multi-fragment effects on the GPU using the k-buffer", without its merging
// Memory: 128 bytes per list (160 with depths at exits), and 4.
#include "library/range_vec4.glsl"

uint layout_open(List list) { return 0u; }
void layout_emit(List list, inout uint cursor, Range range) {
    if (cursor < K) {
        set_range(list.index * K + cursor, range);
    }
    ++cursor;
}
void layout_close(List list, uint cursor) {
    set_counts(list.index, min(cursor, K));
    if (cursor > K) count_lost(cursor - K);
}

// The next range, and the end of the list.
Iterator layout_begin(List list, Query query) { return Iterator(list.index * K, list.index * K + fetch_counts(list.index)); }
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    ++it.x;
    return range;
}
