#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the lists of the pages that others are split into: of those that are asked for, what touches them and may shadow who asks. Count, or fill after the scan.
// Reads:   pages, units (sums), receivers (of the parts), bin_entries, page_entries, triangles, raster_vertices; fill: places (scanned counts)
// Writes:  count: Counts (by page, part, unit and invocation); fill: Entries
// Grid:    8 invocations per unit
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/order.h"
#include "math/texel_range.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
layout(constant_id = 1) const bool kOrthographic = false;
READ_UINT(1, bin_entries)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
READ_UVEC4(4, pages)
READ_UINT(5, units)
READ_UVEC2(6, receivers)
READ_UINT(7, places)
READ_UINT(41, page_entries)
layout(binding = 8, scalar) writeonly buffer Counts { uint counts[]; };
layout(binding = 9, scalar) writeonly buffer Entries { uint entries[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/split_page.glsl"
#include "common/page_units.glsl"

void main() {
    uint unit = group_index() * 8u + (gl_LocalInvocationID.x >> 3u);
    uint lane = gl_LocalInvocationID.x & 7u;
    if (unit >= params.unit_count) return;
    uint i = page_of_unit(unit);
    uint first_unit = fetch_units(i);
    uint page_units = fetch_units(i + 1u) - first_unit;
    uint number = params.page_first + i;
    Page page = unpack_page(params.grid, fetch_pages(2u * number), fetch_pages(2u * number + 1u));
    uint split = page.split;

    uint count_first = first_unit * kUnitCounts + (unit - first_unit) * 8u + lane;
    uint count_step = page_units * 8u;  // From one part to the next.
    bool asked[4];
    float limit[4];
    uint receiver[4];
    uint count[4];
    [[unroll]] for (uint q = 0u; q < 4u; ++q) {
        uvec2 by = fetch_receivers(4u * first_unit + q);
        asked[q] = by.x != 0u;
        limit[q] = from_ordered_bits(by.x);
        receiver[q] = by.y - 1u;
        count[q] = kFill ? fetch_places(count_first + q * count_step) : 0u;
    }
    uint k = page.begin + (unit - first_unit) * kPageUnit;
    uint end = min(page.end, k + kPageUnit);
    for (k += lane; k < end; k += 8u) {
        bool handed_down = k >= params.entry_first;
        uint from_bins = fetch_bin_entries(handed_down ? 0u : k);
        uint entry = handed_down ? fetch_page_entries(k - params.entry_first) : from_bins;
        MovingTriangle m = fetch_entry_triangle(page, entry);
        [[unroll]] for (uint q = 0u; q < 4u; ++q) {
            Page part = part_of(page, split, q);
            CellTriangle c = in_cell(part, m);
            bool listed = asked[q] && (entry & ~kReversed) != receiver[q] && nearest_depth(c, kOrthographic) < limit[q] && touches(part, c);
            if (kFill && listed) entries[params.entry_next - params.entry_first + count[q]] = entry;
            count[q] += listed ? 1u : 0u;
        }
    }
    if (!kFill) {
        [[unroll]] for (uint q = 0u; q < 4u; ++q) counts[count_first + q * count_step] = count[q];
    }
}
