// SPDX-License-Identifier: Apache-2.0
// What a layout makes of each list, or tile, when it is filled. Needs: common/stage.glsl, and GN_RANGE_EXIT where ranges have a depth at their exit

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { RasterParams params; };
#define LAYOUT_WRITE
#include "common/s_buffer.glsl"

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
#ifdef LAYOUT_FINISHES_TILES
    if (i < params.item_count) layout_finish(Tile(part_first_tile() + i));
#else
    if (i < params.item_count * kTileTexels) layout_finish(list_at(part_first_tile() + i / kTileTexels, i % kTileTexels));
#endif
}
