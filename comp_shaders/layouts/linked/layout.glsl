// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "linked": a linked list per texel and cell, nodes from a global counter in the order of arrival.
// Based on: Yang et al. 2010, "Real-time concurrent linked list construction on the GPU"; the papers of 2017 and 2018 use it.
// Memory: 16 bytes per range (20 with the depth at its exit) and 4 for its link, 4 bytes per list.
#include "library/range_vec4.glsl"

uint layout_open(List list) { return 0u; }
void layout_emit(List list, inout uint cursor, Range range) {
    uint node = allocate_ranges(1u);
    set_range(node, range);
    set_links(node, exchange_heads(list.index, node));
}
void layout_close(List list, uint cursor) {}

// The next node.
Iterator layout_begin(List list, Query query) { return fetch_heads(list.index); }
bool layout_more(Iterator it) { return it != kNone; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it);
    it = fetch_links(it);
    return range;
}
