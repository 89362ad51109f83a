// SPDX-License-Identifier: Apache-2.0
// The lists of an S-buffer in a layout (docs/layouts.md). With LAYOUT_WRITE defined its buffers can be written and read, with LAYOUT_READ read; with neither there are
// none. Numbers count from the first of what is in memory, a band. Needs: common/stage.glsl; with LAYOUT_WRITE, RasterParams params
struct List {
    uint index;
    uint tile;
    uint texel;  // Of the tile: row * kTileSize + column.
};

struct Tile {
    uint index;
};

struct Range {
    float enter;  // Times of the shutter.
    float leave;
    float depth;  // As the raster stage finds it: at the entry, or the nearest.
    uint entry;   // Triangle, and kReversed.
    float exit_depth;
};

// What of a list is asked for: ranges that hold the time t and are nearer than limit. Others may come too. With `all`, every range.
struct Query {
    float t;
    float limit;
    bool all;
};

// Of the range that is emitted, by raster/conservative: its triangle's number among those of the tile's list, and the times of the shutter between which its cell lies.
uint emitted_triangle = 0u;
vec2 emitted_cell = vec2(0.0, 1.0);

#include "layout_interface.glsl"

List list_at(uint tile, uint texel) {
    uint order = texel;
#ifdef LAYOUT_MORTON
    uvec2 at = uvec2(texel & 7u, texel >> 3u);
    uvec2 spread = (at & 1u) | ((at & 2u) << 1u) | ((at & 4u) << 2u);
    order = spread.x | (spread.y << 1u);
#endif
    return List(tile * kTileTexels + order, tile, texel);
}

Tile tile_of(List list) { return Tile(list.tile); }

#include "layout.glsl"

#if defined(LAYOUT_CHECKED) && defined(LAYOUT_READ)
// One dispatch walks kListChunk ranges of a list, and a few of what only contains them more: a walk of many more does not end.
const uint kMostSteps = 2u * kListChunk;
uint walk_steps = 0u, walked_list = 0u;
bool checked_more(Iterator it) {
    bool more = layout_more(it);
    walk_steps += more ? 1u : 0u;
    if (walk_steps == kMostSteps) count_fault(kWalks, walked_list);
    return more && walk_steps < kMostSteps;
}
Iterator checked_begin(List list, Query query) {
    walked_list = list.index;
    return layout_begin(list, query);
}
#define layout_more checked_more
#define layout_begin checked_begin
#endif

#ifdef LAYOUT_NOTED
void note_hit(uint i, bool here) {
    reading_hit = i;
    read_is_kept = here && (i / kReadGroup) * 0x9e3779b1u <= reads_head.below;
}
void note_query() { note_read(kQueryBegins, 0u); }
void note_round() { read_when = (read_when & 0xffff0000u) + 0x10000u; }
Range noted_next(inout Iterator it, Query query) {
    ++read_when;
    note_read(kTurnBegins, 0u);
    return layout_next(it, query);
}
#define layout_next noted_next
#else
#define note_hit(i, here)
#define note_query()
#define note_round()
#endif
