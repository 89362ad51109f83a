// SPDX-License-Identifier: Apache-2.0
// A function of the layout for each list, or tile. Needs: common/stage.glsl; GN_RANGE_EXIT where ranges have a depth at their exit; LAYOUT_FUNCTION, its name, and
// LAYOUT_OF_TILES, whether it is of tiles

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { RasterParams params; };
#define LAYOUT_WRITE
#include "common/s_buffer.glsl"

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
#if LAYOUT_OF_TILES
    if (i < params.item_count) LAYOUT_FUNCTION(Tile(part_first_tile() + i));
#else
    if (i < params.item_count * kTileTexels) LAYOUT_FUNCTION(list_at(part_first_tile() + i / kTileTexels, i % kTileTexels));
#endif
}
