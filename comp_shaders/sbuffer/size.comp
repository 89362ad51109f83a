#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: what each list takes of a size that the layout computes from the number of its ranges; or each tile, from those of its lists.
// Reads:   counts (ranges per list of the window)
// Writes:  Sizes (per list, or tile), SizeTotals (64 bits per kCountBlock items)
// Grid:    one invocation per list, or tile
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kSize = 1u;
layout(constant_id = 1) const bool kTiles = false;
READ_UINT(0, counts)
layout(binding = 1, scalar) writeonly buffer Sizes { uint sizes[]; };
layout(binding = 2, scalar) buffer SizeTotals { uvec2 range_counts[]; };
layout(push_constant, scalar) uniform Push { SizeParams params; };
#include "common/range_count.glsl"
#include "common/s_buffer.glsl"

uint size_of(uint tile, uint texel) {
    uint size = 0u;
    List list = list_at(tile, texel);
    uint longest = 0u, sum = 0u;
    for (uint i = 0u; i < (kTiles ? kTileTexels : 1u); ++i) {
        uint count = fetch_counts(kTiles ? tile * kTileTexels + i : list.index);
        longest = max(longest, count);
        sum += count;
    }
    // Its index is not known yet.
    list.index = kNone;
#define VISIT(name, number) if (!kTiles && kSize == number) size = layout_size_##name(list, sum);
    LAYOUT_LIST_SIZES
#undef VISIT
#define VISIT(name, number) if (kTiles && kSize == number) size = layout_size_##name(longest, sum);
    LAYOUT_TILE_SIZES
#undef VISIT
    return size;
}

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint first = kTiles ? params.list_first / kTileTexels : params.list_first;
    // Of lists a whole workgroup.
    if (i >= (kTiles ? params.list_count / kTileTexels : params.list_count)) return;
    uint number = first + i;
    uint tile = kTiles ? number : number / kTileTexels;
    uint texel = kTiles ? 0u : number % kTileTexels;
    uint size = size_of(tile, texel);
    sizes[kTiles ? i : list_at(tile, texel).index - params.list_first] = size;
    if (kTiles) {
        add_to_block(tile / kCountBlock, size);
    } else {
        add_range_count(tile / kCountBlock, size);
    }
}
