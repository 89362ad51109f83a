// SPDX-License-Identifier: Apache-2.0
// Where a tile's 64 samples of one stratum lie in memory: in blocks of 4x2 pixels, so that the hits that a subgroup works on
// are neighbours in both directions and meet the same triangles and texels.
#ifndef GNOMON_SHARED_SLOT_H
#define GNOMON_SHARED_SLOT_H
#include "lang.h"
GN_BEGIN

// slot = row / 2 (2 bits), column / 4 (1), row % 2 (1), column % 4 (2)
GN_FN uint tile_slot(uint column, uint row) {
    return ((row >> 1u) << 4u) | ((column >> 2u) << 3u) | ((row & 1u) << 2u) | (column & 3u);
}

GN_FN uint slot_column(uint slot) { return ((slot >> 1u) & 4u) | (slot & 3u); }
GN_FN uint slot_row(uint slot) { return ((slot >> 3u) & 6u) | ((slot >> 2u) & 1u); }

GN_END
#endif
