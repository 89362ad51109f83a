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
layout(binding = 4, scalar) buffer Pages { uvec4 pages[]; };
layout(binding = 5, scalar) writeonly buffer Units { uint units[]; };
layout(binding = 6, scalar) buffer Longest { uint longest; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/split_page.glsl"
#include "common/page_entry.glsl"

const uint kSamples = 64u;
// Of four parts that a prism lies in, in the mean: where there are more, one splitting thins the lists little,
const float kMostParts = 2.5;
// but where half of the triangles are so many times smaller than the page, or than their way in its cell, the next ones do.
const float kSmall = 3.0;

shared uint s_parts[8][3];

// Is the triangle small, compared with the page or with its way?
bool is_small(CellTriangle c) {
    vec2 a0 = c.a0.xy / c.a0.w, a1 = c.a1.xy / c.a1.w, a2 = c.a2.xy / c.a2.w, b0 = c.b0.xy / c.b0.w;
    vec2 size = max(max(abs(a1 - a0), abs(a2 - a0)), abs(a2 - a1)), way = abs(b0 - a0);
    return cell_in_front(c) && kSmall * max(size.x, size.y) < max(float(kTileSize), max(way.x, way.y));
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

    if (lane < 3u) s_parts[here][lane] = 0u;
    barrier();
    if (is_long) {
        uvec2 parts = uvec2(0u);
        uint small = 0u;
        for (uint s = lane; s < kSamples; s += 8u) {
            // Without overflow: s * count / kSamples.
            uint k = s * (count / kSamples) + s * (count % kSamples) / kSamples;
            MovingTriangle m = fetch_entry_triangle(page, fetch_page_entry(page.begin + k));
            CellTriangle c = in_cell(page, m);
            parts += uvec2(bitCount(parts_in_space(page, c)), bitCount(parts_in_time(page, m)));
            small += is_small(c) ? 1u : 0u;
        }
        atomicAdd(s_parts[here][0], parts.x);
        atomicAdd(s_parts[here][1], parts.y);
        atomicAdd(s_parts[here][2], small);
    }
    barrier();
    if (!inside || lane != 0u) return;
    uint split = 0u;
    if (is_long) {
        uint space = in_space ? s_parts[here][0] : 4u * kSamples, time = in_time ? s_parts[here][1] : 4u * kSamples;
        bool pays = float(min(space, time)) <= kMostParts * float(kSamples) || s_parts[here][2] > kSamples / 2u;
        // Of equally good ways the one in space, while there is: its texels are smaller, too.
        if (pays) split = in_space && space <= time || !in_time ? kSplitSpace : kSplitTime;
    }
    units[i] = split != 0u ? (count + kPageUnit - 1u) / kPageUnit : 0u;
    if (split != 0u) {
        pages[2u * number + 1u].w = split;
    } else if (longest < count) {
        atomicMax(longest, count);
    }
}
