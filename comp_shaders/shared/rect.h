// SPDX-License-Identifier: Apache-2.0
// The tiles of the window that a prism may touch in one cell of time, in two words: x: first x (12 bits), last x (12),
// orientations (2), large (1); y: first y, last y.
#ifndef GNOMON_SHARED_RECT_H
#define GNOMON_SHARED_RECT_H
#include "params.h"
GN_BEGIN

struct Rect {
    uvec2 first;
    uvec2 last;
    uint seen;   // kSeenPositive, kSeenNegative; 0: not visible.
    bool large;  // rect_is_large, of the whole view.
};

GN_FN uvec2 pack_rect(uvec2 first, uvec2 last, uint seen, bool large) {
    return uvec2(first.x | (last.x << 12u) | (seen << 24u) | (large ? 1u << 26u : 0u), first.y | (last.y << 12u));
}

GN_FN Rect unpack_rect(uvec2 r) {
    Rect rect;
    rect.first = uvec2(r.x & 4095u, r.y & 4095u);
    rect.last = uvec2((r.x >> 12u) & 4095u, (r.y >> 12u) & 4095u);
    rect.seen = (r.x >> 24u) & 3u;
    rect.large = ((r.x >> 26u) & 1u) != 0u;
    return rect;
}

GN_FN uint rect_tiles(uvec2 first, uvec2 last) { return (last.x - first.x + 1u) * (last.y - first.y + 1u); }

// Large prisms are tested against each tile (bin/large), small ones are not (bin/small). first, last: in the whole view, so
// that a tile's lists do not depend on the window. in_front: all of it has w > 0, so the bounds are tight.
GN_FN bool rect_is_large(uvec2 first, uvec2 last, bool in_front) { return !in_front || rect_tiles(first, last) > kSmallTiles; }

// Tiles that each invocation of bin/large looks at, one after the other.
GN_FN uint rect_rounds(uvec2 first, uvec2 last) {
    const uint at_once = kMostBlocks * kBlockTiles;
    return (rect_tiles(first, last) + at_once - 1u) / at_once;
}

// Blocks that bin/large spends on the prism, at most kMostBlocks.
GN_FN uint rect_blocks(uvec2 first, uvec2 last) {
    uint tiles = kBlockTiles * rect_rounds(first, last);
    return (rect_tiles(first, last) + tiles - 1u) / tiles;
}

GN_END
#endif
