#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the lists of the pages that others are split into.
// Reads:   pages, units (sums), sieves, places (scanned counts of pages/sift), bin_entries, page_entries
// Writes:  Entries
// Grid:    8 invocations per unit
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
READ_UINT(1, bin_entries)
READ_UVEC4(4, pages)
READ_UINT(5, units)
READ_UINT(6, sieves)
READ_UINT(7, places)
layout(binding = 9, scalar) writeonly buffer Entries { uint entries[]; };
layout(push_constant, scalar) uniform Push { PageParams params; };
#include "common/page.glsl"
#include "common/page_entry.glsl"
#include "common/page_units.glsl"

void main() {
    uint number = group_index() * 8u + (gl_LocalInvocationID.x >> 3u);
    uint lane = gl_LocalInvocationID.x & 7u;
    if (number >= params.unit_count) return;
    Unit unit = fetch_unit(number);
    uint place[4];
    [[unroll]] for (uint q = 0u; q < 4u; ++q) {
        place[q] = params.entry_next - params.entry_first + fetch_places(part_place(unit, q) + (number - unit.first) * 8u + lane);
    }
    uvec2 list = unit_entries(unit);
    uint k = list.x + lane;
    uint word = number * (kPageUnit / 8u) + lane;
    while (k < list.y) {
        uint sieve = fetch_sieves(word);
        [[unroll]] for (uint j = 0u; j < 8u; ++j) {
            uint parts = sieve >> (4u * j) & 0xfu;
            uint entry = fetch_page_entry(k < list.y ? k : list.x);
            [[unroll]] for (uint q = 0u; q < 4u; ++q) {
                bool listed = (parts >> q & 1u) != 0u;
                if (listed) entries[place[q]] = entry;
                place[q] += listed ? 1u : 0u;
            }
            k += 8u;
        }
        word += 8u;
    }
}
