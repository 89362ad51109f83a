#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: which of the new pages are split, in space or in time: those with long lists, in the way that leaves shorter ones, if one does. As many of a page's
//          prisms as kSamples decide, evenly spread over its list.
// Reads:   bin_entries, page_entries, triangles, raster_vertices
// Writes:  Pages (split), Units (per new page: units of kPageUnit entries if it is split, else 0), Longest (entries of a page that is not split)
// Grid:    8 invocations per page
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/texel_range.h"

layout(local_size_x = 64) in;
READ_UINT(1, bin_entries)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
READ_UINT(41, page_entries)
layout(binding = 4, scalar) buffer Pages { uvec4 pages[]; };
layout(binding = 5, scalar) writeonly buffer Units { uint units[]; };
layout(binding = 6, scalar) buffer Longest { uint longest; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/split_page.glsl"

const uint kSamples = 64u;
// Of four parts, that a prism lies in: where there are more in the mean, splitting multiplies entries without making lists much shorter.
const float kMostParts = 2.5;

shared uint s_parts[8][2];

uint fetch_entry(uint k) {
    bool handed_down = k >= params.entry_first;
    uint own = fetch_bin_entries(handed_down ? 0u : k);
    return handed_down ? fetch_page_entries(k - params.entry_first) : own;
}

void main() {
    uint here = gl_LocalInvocationID.x >> 3u;
    uint lane = gl_LocalInvocationID.x & 7u;
    uint i = group_index() * 8u + here;
    bool inside = i < params.page_count;
    uint number = params.page_first + min(i, params.page_count - 1u);
    Page page = unpack_page(params.grid, pages[2u * number], pages[2u * number + 1u]);
    uint count = page.end - page.begin;
    bool in_space = page.level < kMostLevel, in_time = page.time_level < kMostTimeLevel;
    bool is_long = inside && count > kLongPage && (in_space || in_time);

    if (lane < 2u) s_parts[here][lane] = 0u;
    barrier();
    if (is_long) {
        uvec2 parts = uvec2(0u);
        for (uint s = lane; s < kSamples; s += 8u) {
            // Without overflow: s * count / kSamples.
            uint k = s * (count / kSamples) + s * (count % kSamples) / kSamples;
            MovingTriangle m = fetch_entry_triangle(page, fetch_entry(page.begin + k));
            for (uint q = 0u; q < 4u; ++q) {
                Page quarter = part_of(page, kSplitSpace, q), moment = part_of(page, kSplitTime, q);
                parts.x += touches(quarter, in_cell(quarter, m)) ? 1u : 0u;
                parts.y += touches(moment, in_cell(moment, m)) ? 1u : 0u;
            }
        }
        atomicAdd(s_parts[here][0], parts.x);
        atomicAdd(s_parts[here][1], parts.y);
    }
    barrier();
    if (!inside || lane != 0u) return;
    uint split = 0u;
    if (is_long) {
        uint space = in_space ? s_parts[here][0] : 4u * kSamples, time = in_time ? s_parts[here][1] : 4u * kSamples;
        // Of equally good ways the one in space: its texels are smaller, too.
        if (float(min(space, time)) <= kMostParts * float(kSamples)) split = space <= time ? kSplitSpace : kSplitTime;
    }
    units[i] = split != 0u ? (count + kPageUnit - 1u) / kPageUnit : 0u;
    if (split != 0u) {
        pages[2u * number + 1u].w = split;
    } else if (longest < count) {
        atomicMax(longest, count);
    }
}
