// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "hash": open addressing in one table for all lists, twice as long as there are ranges: [owner] [range]. Probe k of a list is its number plus an offset that
// is the same for all lists, so that neighbours look at neighbouring memory (coherent hashing). A walk looks along its probes until it has seen all its ranges.
// Based on: Lefebvre, Hornus, Lasram 2013, "HA-buffer: coherent hashing for single-pass A-buffer"; without their order by depth
// Memory: 40 bytes per range (48 with the depth at its exit), 8 bytes per list.
#include "library/range_vec4.glsl"

uint probe(uint list, uint k) { return (list + k * 2654435769u) % length_owners(); }

// The next probe.
uint layout_open(List list) { return 0u; }
void layout_emit(List list, inout uint cursor, Range range) {
    uint place = 0u;
    bool taken = true;
    while (taken) {
        place = probe(list.index, cursor++);
        taken = compare_exchange_owners(place, kNone, list.index) != kNone;
    }
    set_range(place, range);
}
void layout_close(List list, uint cursor) {}

// The list, the next probe, how many ranges are left.
Iterator layout_begin(List list, Query query) { return Iterator(list.index, 0u, size_ranges(list)); }
bool layout_more(Iterator it) { return it.z > 0u; }
Range layout_next(inout Iterator it, Query query) {
    uint place = probe(it.x, it.y++);
    while (fetch_owners(place) != it.x) place = probe(it.x, it.y++);
    --it.z;
    return fetch_range(place);
}
