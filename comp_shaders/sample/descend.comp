#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: hits whose page is split ask for the part of it that they lie in.
// Reads:   queue, hits, asked, leaves, pages, units (sums)
// Writes:  AskedNodes (as sample/ask), Receivers (of the parts, common/ask.glsl)
// Grid:    one invocation per hit
#extension GL_GOOGLE_include_directive : require
#include "common/light_hit.glsl"

READ_VEC4(5, asked)
READ_UINT(6, leaves)
READ_UVEC4(14, pages)
READ_UINT(15, units)
layout(binding = 7, scalar) coherent buffer Receivers { uvec2 receivers[]; };
layout(binding = 10, scalar) buffer AskedNodes { uvec2 asked_nodes[]; };
#include "common/ask.glsl"

void main() {
    uint i = take_hit();
    if (i >= hit_count()) return;
    uvec2 node_time = asked_nodes[i];
    if (node_time.x == kNone) return;
    uint leaf = fetch_leaves(node_time.x & ~kReversed);
    uint number = leaf >> 4u;
    if (leaf == kNone || number < params.item_first) return;
    uvec4 place = fetch_pages(2u * number);
    uint split = fetch_pages(2u * number + 1u).w;
    if (split == 0u) return;

    ShadowTest test;
    vec4 held = fetch_asked(i);
    test.at = held.xy;
    test.limit = held.z;
    test.depth = held.w;
    test.behind = (node_time.x & kReversed) != 0u;
    uint level = place.x >> 24u, time_level = place.y >> 24u;
    uvec2 part = texel_at(test.at, level + 1u) / kTileSize - 2u * (place.xy & 0xffffffu);
    uint moment = cell_of(uintBitsToFloat(node_time.y), params.light_cell_count << (2u * time_level + 2u)) - 4u * place.z;
    uint q = split == kSplitSpace ? part.y * 2u + part.x : moment;
    uint part_node = 4u * fetch_units(number - params.item_first) + min(q, 3u);
    asked_nodes[i].x = (params.range_first + part_node) | (node_time.x & kReversed);
    ask_for(part_node, fetch_hits(fetch_queue(i)) & ~kReversed, deepest(test));
}
