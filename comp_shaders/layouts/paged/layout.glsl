// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "paged": a linked list of pages, each of PAGE ranges side by side. The last page of a list is filled last, and may have room left.
// Based on: Crassin 2010, "Linked lists of fragment pages"
// Memory: 64 bytes per page (80 with depths at exits) and 4 for its link, 12 bytes per list.
#include "library/range_vec4.glsl"

uint layout_size_pages(List list, uint count) { return (count + PAGE - 1u) / PAGE; }

// The place of the next range; a multiple of PAGE: it needs a new page. kNone: there is none yet.
uint layout_open(List list) { return kNone; }
void layout_emit(List list, inout uint cursor, Range range) {
    if (cursor == kNone || cursor % PAGE == 0u) {
        uint page = allocate_pages(1u);
        if (cursor == kNone) {
            set_heads(list.index, page);
        } else {
            set_links(cursor / PAGE - 1u, page);
        }
        cursor = page * PAGE;
    }
    set_range(cursor, range);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// The next range, and how many are left.
Iterator layout_begin(List list, Query query) { return Iterator(fetch_heads(list.index) * PAGE, size_ranges(list)); }
bool layout_more(Iterator it) { return it.y > 0u; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    --it.y;
    bool turns = it.x % PAGE == PAGE - 1u && it.y > 0u;
    uint next = fetch_links(turns ? it.x / PAGE : 0u) * PAGE;
    it.x = turns ? next : it.x + 1u;
    return range;
}
