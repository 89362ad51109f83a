#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the triangles of each tile's list, for layouts that have a size of that name.
// Reads:   bin_offsets, pages
// Writes:  Sizes (per item), SizeTotals (64 bits per kCountBlock items)
// Grid:    one invocation per item
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kAsked = false;
READ_UINT(0, bin_offsets)
READ_UINT(1, bin_entries)
layout(binding = 2, scalar) writeonly buffer Sizes { uint sizes[]; };
layout(binding = 3, scalar) buffer SizeTotals { uvec2 range_counts[]; };
layout(push_constant, scalar) uniform Push { RasterParams params; };
#include "common/source_page.glsl"
#include "common/range_count.glsl"

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= params.item_count) return;
    Page page = fetch_page(i);
    uint size = max(page.end, page.begin) - page.begin;
    sizes[i] = size;
    add_to_block(i / kCountBlock, size);
}
