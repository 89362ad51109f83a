#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the pages, in the order of their items.
// Reads:   receivers, page_of (scanned marks)
// Writes:  Pages (item; the triangle that all receivers lie on, or kNone; the farthest limit of their depths)
// Grid:    one invocation per item
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/order.h"

layout(local_size_x = 64) in;
READ_UVEC2(0, receivers)
READ_UINT(1, page_of)
layout(binding = 2, scalar) writeonly buffer Pages { uvec4 pages[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };

void main() {
    uint item = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (item >= params.item_count) return;
    uint page = fetch_page_of(item);
    if (fetch_page_of(item + 1u) == page) return;
    uvec2 receiver = fetch_receivers(item);
    pages[page] = uvec4(item, receiver.y == kNone ? kNone : receiver.y - 1u, floatBitsToUint(from_ordered_bits(receiver.x)), 0u);
}
