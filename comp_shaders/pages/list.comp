#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the pages of the view's own level, in the order of their items.
// Reads:   receivers, page_of (scanned marks), bin_offsets
// Writes:  Pages (two uvec4 each, common/page.glsl), Leaves (per item: its page * 16, or kNone)
// Grid:    one invocation per item
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
READ_UVEC2(0, receivers)
READ_UINT(1, page_of)
READ_UINT(2, bin_offsets)
layout(binding = 3, scalar) writeonly buffer Pages { uvec4 pages[]; };
layout(binding = 4, scalar) writeonly buffer Leaves { uint leaves[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/page.glsl"

void main() {
    uint item = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (item >= params.node_first) return;
    uint number = fetch_page_of(item);
    bool listed = fetch_page_of(item + 1u) != number;
    leaves[item] = listed ? number << 4u : kNone;
    if (!listed) return;
    Page page = item_page(params.grid, item, fetch_bin_offsets(item), fetch_bin_offsets(item + 1u));
    set_receiver(page, fetch_receivers(item));
    pages[2u * number] = page_place(page);
    pages[2u * number + 1u] = page_list(page);
}
