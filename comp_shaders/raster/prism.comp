#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the ranges of each texel from its fragments: one prism's, in the order of their depth, two and two. A fragment that is left over makes no range: its
//          prism passes the eye. Count, or fill after the layout's own preparation.
// Reads:   fragment_heads, fragments (raster/fragments)
// Writes:  RasterCounts (ranges, 64 bits per kCountBlock items), PairCounts (per kCountBlock items: fragments left over; prisms with more than four), Resume (with kResume: where
//          each list's walk goes on), and what the layout says
// Grid:    one workgroup per tile and cell, one invocation per texel
// Based on: Hong and Oh 2018, "Motion-blurred shadows utilizing a depth-time ranges shadow map", section 4.3
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/prism.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
layout(constant_id = 1) const bool kResume = false;  // Lists are walked in parts.
layout(constant_id = 2) const bool kAsked = false;
READ_UVEC4(15, pages)
READ_UINT(0, fragment_heads)
READ_UVEC4(1, fragments)
layout(binding = 2, scalar) buffer PairCounts { uvec2 pair_counts[]; };
layout(binding = 3, scalar) buffer Resume { uint resume[]; };
layout(binding = 4, scalar) buffer RasterCounts { uvec2 range_counts[]; };
layout(push_constant, scalar) uniform Push { RasterParams params; };
#include "common/spread.glsl"
#include "common/range_count.glsl"
#define GN_RANGE_EXIT
#include "common/write_lists.glsl"

void main() {
    uint number = spread_first(params.item_count, 1u);
    bool inside = number < params.item_count;
    number = min(number, params.item_count - 1u);
    uint item = params.item_first + number;
    uint texel = gl_LocalInvocationID.x;
    List list = list_at(item - params.band_first, texel);
    uint walk = number * kTileTexels + texel;
    ViewGrid grid = params.grid;
    float cell_start = float(kAsked ? fetch_pages(2u * item).z : item - item / grid.cell_count * grid.cell_count);
    float per_cell = 1.0 / float(grid.cell_count);

    // Fragments of the prism at hand, by depth; equally deep ones by time.
    vec2 sorted[kPrismTriangles];
    [[unroll]] for (uint i = 0u; i < kPrismTriangles; ++i) sorted[i] = vec2(kFarthest, 0.0);
    uint count = 0u, cursor = 0u, left_over = 0u, several = 0u;
    if (kFill && inside) cursor = open_list(list);
    uint node = fetch_fragment_heads((item - params.fragment_item) * kTileTexels + texel);
    if (kResume && params.list_first > 0u) node = resume[walk];
    uint id = kNone, held = 0u, steps = 0u;
    bool more = inside && node != kNone;
    while (more) {
        uvec4 fragment = fetch_fragments(node != kNone ? node : 0u);
        uint next_id = node != kNone ? fragment.z : kNone;
        bool ends = next_id != id;
        if (ends) {
            [[unroll]] for (uint i = 0u; i + 1u < kPrismTriangles; i += 2u) {
                if (i + 1u < held) {
                    bool in_order = sorted[i].y <= sorted[i + 1u].y;
                    vec2 enter = in_order ? sorted[i] : sorted[i + 1u], leave = in_order ? sorted[i + 1u] : sorted[i];
                    if (kFill) {
                        float start = (cell_start + enter.y) * per_cell, end = (cell_start + leave.y) * per_cell;
                        layout_emit(list, cursor, Range(start, end, enter.x, id, leave.x));
                    }
                    ++count;
                }
                sorted[i] = vec2(kFarthest, 0.0);
                sorted[i + 1u] = vec2(kFarthest, 0.0);
            }
            left_over += held & 1u;
            several += held > 4u ? 1u : 0u;
            held = 0u;
        }
        id = next_id;
        more = node != kNone && !(kResume && ends && steps >= kPairChunk);
        if (more) {
            vec2 moved = uintBitsToFloat(fragment.xy);
            [[unroll]] for (uint i = 0u; i < kPrismTriangles; ++i) {
                vec2 here = sorted[i];
                bool before = moved.x < here.x || (moved.x == here.x && moved.y < here.y);
                sorted[i] = before ? moved : here;
                moved = before ? here : moved;
            }
            node = fragment.w;
            ++held;
            ++steps;
        }
    }
    if (kResume && inside) resume[walk] = node;
    if (!kFill) {
        if (inside) count_ranges(list, count);
        add_range_count(item / kCountBlock, inside ? count : 0u);
        uint all_left = subgroupAdd(left_over);
        uint all_several = subgroupAdd(several);
        if (subgroupElect() && all_left + all_several > 0u) {
            atomicAdd(pair_counts[item / kCountBlock].x, all_left);
            atomicAdd(pair_counts[item / kCountBlock].y, all_several);
        }
    } else if (inside) {
        close_list(list, cursor);
    }
}
