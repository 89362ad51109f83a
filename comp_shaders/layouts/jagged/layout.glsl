// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "jagged": slot-major tiles. A tile has as many slots as its longest list has ranges; slot k holds range k of each of its 64 lists side by side, so that
// a subgroup that walks neighbouring lists in step reads neighbouring memory. Shorter lists leave their places in later slots unused.
// Memory: 16 bytes per range of the longest list of a tile (20 with the depth at its exit) for each of its 64, 8 bytes per list, 8 per tile.
#include "library/range_vec4.glsl"

uint layout_size_slots(uint longest, uint sum) { return longest; }

// Where the next range goes.
uint layout_open(List list) { return first_slots(tile_of(list)) * kTileTexels + list.texel; }
void layout_emit(List list, inout uint cursor, Range range) {
    set_range(cursor, range);
    cursor += kTileTexels;
}
void layout_close(List list, uint cursor) {}

// The next range, and how many are left.
Iterator layout_begin(List list, Query query) { return Iterator(first_slots(tile_of(list)) * kTileTexels + list.texel, size_ranges(list)); }
bool layout_more(Iterator it) { return it.y > 0u; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    it.x += kTileTexels;
    --it.y;
    return range;
}
