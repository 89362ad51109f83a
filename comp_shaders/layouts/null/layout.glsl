// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "null": nothing is stored, and nothing is found. The floor of what a layout can cost.
// Memory: none.

uint layout_open(List list) { return 0u; }
void layout_emit(List list, inout uint cursor, Range range) { ++cursor; }
void layout_close(List list, uint cursor) {
    if (cursor > 0u) count_lost(cursor);
}

Iterator layout_begin(List list, Query query) { return 0u; }
bool layout_more(Iterator it) { return false; }
Range layout_next(inout Iterator it, Query query) { return Range(0.0, 0.0, 0.0, 0u, 0.0); }
