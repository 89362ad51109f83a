#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: how many ranges each texel has, its lists in all cells of time added up.
// Reads:   what the layout says
// Writes:  TexelRanges (per texel, rows from the top), Iterators (when lists are walked in parts)
// Grid:    one invocation per list
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kResume = false;  // Lists are walked in parts of kListChunk.
layout(binding = 0, scalar) buffer TexelRanges { uint texel_ranges[]; };
layout(binding = 1, scalar) buffer Iterators { uvec2 iterators[]; };
layout(push_constant, scalar) uniform Push { TexelRangesParams params; };
uint range_base() { return params.range_first; }
#define ListIterator uvec2
#define LAYOUT_READ
#include "layout.glsl"

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint item = params.item_first + min(i / kTileTexels, params.item_count - 1u);
    uint texel = i % kTileTexels;
    uint window_tile = item / params.grid.cell_count;
    uint tile = params.grid.tile_first + window_tile;
    uint tile_y = tile / params.grid.tiles_x;
    uint column = (tile - tile_y * params.grid.tiles_x) * kTileSize + texel % kTileSize;
    uint row = tile_y * kTileSize + texel / kTileSize;
    bool inside = i < params.item_count * kTileTexels && column < params.grid.width && row < params.grid.height;

    ListIterator it = layout_begin(item * kTileTexels + texel);
    if (kResume && params.part > 0u && inside) it = iterators[i];
    uint count = 0u;
    bool more = inside && layout_more(it);
    while (more) {
        layout_next(it);
        ++count;
        more = layout_more(it) && count < kListChunk;
    }
    if (kResume && inside) iterators[i] = it;
    if (count > 0u) atomicAdd(texel_ranges[row * params.grid.width + column], count);
}
