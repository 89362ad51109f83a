// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "linked": a linked list per texel and cell, nodes from a global counter in the order of arrival.
// Based on: Yang et al. 2010, "Real-time concurrent linked list construction on the GPU"; the papers of 2017 and 2018 use it.
// Memory: 16 bytes per range (20 with the depth at its exit) and 4 for its link, 4 bytes per list.

#ifdef LAYOUT_WRITE
layout(binding = 16, scalar) buffer ListHeads { uint list_heads[]; };
layout(binding = 17, scalar) writeonly buffer Ranges { vec4 ranges[]; };
layout(binding = 18, scalar) writeonly buffer Links { uint links[]; };
layout(binding = 19, scalar) buffer NodeCount { uint node_count; };

void layout_count(uint list, uint count, bool first) {}
// The place of the new node.
uint append(uint list, vec4 range) {
    uint node = atomicAdd(node_count, 1u);
    uint place = node - range_base();
    ranges[place] = range;
    links[place] = atomicExchange(list_heads[list], node);
    return place;
}
void layout_emit(uint list, vec4 range) { append(list, range); }
#ifdef GN_RANGE_EXIT
layout(binding = 20, scalar) writeonly buffer RangeExits { float range_exits[]; };
void layout_emit(uint list, vec4 range, float exit_depth) { range_exits[append(list, range)] = exit_depth; }
#endif
#endif

#ifdef LAYOUT_READ
READ_UINT(16, list_heads)
READ_VEC4(17, ranges)
READ_UINT(18, links)

// x: the next node, or kNone.
ListIterator layout_begin(uint list) { return ListIterator(fetch_list_heads(list), 0u); }
ListIterator layout_end() { return ListIterator(kNone, 0u); }
bool layout_more(ListIterator it) { return it.x != kNone; }
vec4 layout_next(inout ListIterator it) {
    uint node = it.x - range_base();
    it.x = fetch_links(node);
    return fetch_ranges(node);
}
#ifdef GN_RANGE_EXIT
READ_FLOAT(19, range_exits)
float layout_exit_depth(ListIterator it) { return fetch_range_exits(it.x - range_base()); }
#endif
#endif
