#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: split the large prisms of one cell into blocks (shared/rect.h), kBlockTiles invocations of bin/large each.
// Reads:   rects of the cell
// Writes:  Blocks (triangle; block number | cell << 20), BlockCount (next free place)
// Grid:    one invocation per triangle
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/rect.h"

layout(local_size_x = 64) in;
READ_UVEC2(0, rects)
layout(binding = 1, scalar) writeonly buffer Blocks { uvec2 blocks[]; };
layout(binding = 2, scalar) buffer BlockCount { uint block_count; };
layout(push_constant, scalar) uniform Push { BinParams params; };

void main() {
    uint triangle = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = triangle < params.triangle_count;
    Rect rect = unpack_rect(fetch_rects(params.rect_first + min(triangle, params.triangle_count - 1u)));
    bool large = inside && rect.seen != 0u && rect.large;
    uint count = large ? rect_blocks(rect.first, rect.last) : 0u;
    uint place = 0u;
    if (count > 0u) place = atomicAdd(block_count, count);
    for (uint i = 0u; i < count; ++i) blocks[place + i] = uvec2(params.triangle_first + triangle, i | (params.cell << 20u));
}
