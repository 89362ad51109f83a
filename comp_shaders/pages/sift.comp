#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: for each prism in the list of a page that is split: which of the parts that somebody asked for it touches, where it may shadow him.
// Reads:   pages, units (sums), receivers (of the parts), bin_entries, page_entries, triangles, raster_vertices
// Writes:  Sieves (4 bits per entry of a unit, of its k-th in word k / 64 * 8 + k % 8), Counts (by page, part, unit and invocation)
// Grid:    8 invocations per unit
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/texel_range.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOrthographic = false;
READ_UINT(1, bin_entries)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
READ_UVEC4(4, pages)
READ_UINT(5, units)
READ_UVEC2(6, receivers)
layout(binding = 7, scalar) writeonly buffer Sieves { uint sieves[]; };
layout(binding = 8, scalar) writeonly buffer Counts { uint counts[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/split_page.glsl"
#include "common/page_entry.glsl"
#include "common/page_units.glsl"

void main() {
    uint number = group_index() * 8u + (gl_LocalInvocationID.x >> 3u);
    uint lane = gl_LocalInvocationID.x & 7u;
    if (number >= params.unit_count) return;
    Unit unit = fetch_unit(number);
    Page page = unit.page;

    float limit[4];
    uint receiver[4];
    uint count[4];
    [[unroll]] for (uint q = 0u; q < 4u; ++q) {
        uvec2 by = fetch_receivers(4u * unit.first + q);
        limit[q] = by.x == 0u ? -kFarthest : from_ordered_bits(by.x);
        receiver[q] = by.y - 1u;
        count[q] = 0u;
    }
    uvec2 entries = unit_entries(unit);
    uint k = entries.x + lane;
    uint word = number * (kPageUnit / 8u) + lane;
    while (k < entries.y) {
        uint sieve = 0u;
        [[unroll]] for (uint j = 0u; j < 8u; ++j) {
            bool inside = k < entries.y;
            uint entry = fetch_page_entry(inside ? k : entries.x);
            MovingTriangle m = fetch_entry_triangle(page, entry);
            CellTriangle c = in_cell(page, m);
            float nearest = nearest_depth(c, kOrthographic);
            uint wanted = 0u;
            [[unroll]] for (uint q = 0u; q < 4u; ++q) wanted |= inside && nearest < limit[q] && (entry & ~kReversed) != receiver[q] ? 1u << q : 0u;
            if (wanted != 0u) {
                if (page.split == kSplitSpace) wanted &= parts_in_space(page, c);
                else wanted &= parts_in_time(page, m);
            }
            sieve |= wanted << (4u * j);
            [[unroll]] for (uint q = 0u; q < 4u; ++q) count[q] += wanted >> q & 1u;
            k += 8u;
        }
        sieves[word] = sieve;
        word += 8u;
    }
    [[unroll]] for (uint q = 0u; q < 4u; ++q) counts[part_place(unit, q) + (number - unit.first) * 8u + lane] = count[q];
}
