// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array": all ranges of a list side by side, lists in order, offsets from a prefix sum of exact counts.
// Memory: 16 bytes per range (20 with the depth at its exit), 4 bytes per list twice (offsets, and the fill's cursors).

#ifdef LAYOUT_WRITE
#define LAYOUT_CURSOR  // The place of a list's next range is kept in a register between emits.
layout(binding = 16, scalar) buffer ListOffsets { uint list_offsets[]; };
layout(binding = 17, scalar) buffer ListCursors { uint list_cursors[]; };
layout(binding = 18, scalar) writeonly buffer Ranges { vec4 ranges[]; };

void layout_count(uint list, uint count, bool first) { list_offsets[list] = count + (first ? 0u : list_offsets[list]); }
uint layout_cursor(uint list) { return list_cursors[list]; }
void layout_set_cursor(uint list, uint cursor) { list_cursors[list] = cursor; }
void layout_emit(uint cursor, vec4 range) { ranges[cursor - range_base()] = range; }
#ifdef GN_RANGE_EXIT
layout(binding = 19, scalar) writeonly buffer RangeExits { float range_exits[]; };
void layout_emit(uint cursor, vec4 range, float exit_depth) {
    layout_emit(cursor, range);
    range_exits[cursor - range_base()] = exit_depth;
}
#endif
#endif

#ifdef LAYOUT_READ
READ_UINT(16, list_offsets)
READ_VEC4(17, ranges)

// x: the next range, y: the end of the list.
ListIterator layout_begin(uint list) { return ListIterator(fetch_list_offsets(list), fetch_list_offsets(list + 1u)); }
ListIterator layout_end() { return ListIterator(0u, 0u); }
bool layout_more(ListIterator it) { return it.x < it.y; }
vec4 layout_next(inout ListIterator it) { return fetch_ranges(it.x++ - range_base()); }
#ifdef GN_RANGE_EXIT
READ_FLOAT(18, range_exits)
float layout_exit_depth(ListIterator it) { return fetch_range_exits(it.x - range_base()); }
#endif
#endif
