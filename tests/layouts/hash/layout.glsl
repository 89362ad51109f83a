// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "hash": open addressing in one table for all lists, twice as long as there are ranges: [owner] [range]. Probe k of a list is its number plus an offset that
// is the same for all lists, so that neighbours look at neighbouring memory (coherent hashing). A walk looks along its probes until it has seen all its ranges.
// For short lists: each probe of a list that an invocation fills or walks is a turn of its loops (docs/decisions/0036-layouts-tried.md).
// Based on: Lefebvre, Hornus, Lasram 2013, "HA-buffer: coherent hashing for single-pass A-buffer"; without their order by depth
// Memory: 40 bytes per range (48 with the depth at its exit), 8 bytes per list.
#include "library/range_vec4.glsl"

// By a prime, which has no divisor in common with the table's length: a list's probes come to each place once before they begin again.
uint next_place(uint place) { return (place + 2654435761u % length_owners()) % length_owners(); }

// The next probe.
uint layout_open(List list) { return list.index % length_owners(); }
void layout_emit(List list, inout uint cursor, Range range) {
    uint place = 0u;
    bool taken = true;
    while (taken) {
        place = cursor;
        cursor = next_place(cursor);
        taken = compare_exchange_owners(place, kNone, list.index) != kNone;
    }
    set_range(place, range);
}
void layout_close(List list, uint cursor) {}

// The list, the next probe, how many ranges are left.
Iterator layout_begin(List list, Query query) { return Iterator(list.index, list.index % length_owners(), size_ranges(list)); }
bool layout_more(Iterator it) { return it.z > 0u; }
Range layout_next(inout Iterator it, Query query) {
    uint place = it.y;
    while (fetch_owners(place) != it.x) place = next_place(place);
    it.y = next_place(place);
    --it.z;
    return fetch_range(place);
}
