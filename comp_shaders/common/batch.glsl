// SPDX-License-Identifier: Apache-2.0
// How the samples of a batch lie in memory: slot = (tile * strata + stratum) * 64 + tile_slot(column, row), tile and stratum counted from the batch's first.
#include "math/sample.h"
#include "shared/slot.h"

// Where and when a pixel of a view is sampled.
vec3 view_sample(bool sliced, uint x, uint y, uint stratum, float stratum_length, uint seed) {
    return sliced ? slice_point(x, y, stratum, stratum_length) : sample_point(pixel_hash(x, y, seed), x, y, stratum, stratum_length);
}

struct Slot {
    uint tile;     // From the batch's first.
    uint stratum;
    uint row;
    uint column;
};

Slot unpack_slot(uint slot, uint stratum_count) {
    Slot s;
    s.column = slot_column(slot);
    s.row = slot_row(slot);
    uint item = slot >> 6u;
    s.tile = divide(item, stratum_count);
    s.stratum = item - s.tile * stratum_count;
    return s;
}

uvec2 slot_pixel(Slot s, uint tile_first, uint tiles_x) {
    uint tile = tile_first + s.tile;
    uint tile_y = divide(tile, tiles_x);
    return uvec2((tile - tile_y * tiles_x) * kTileSize + s.column, tile_y * kTileSize + s.row);
}
