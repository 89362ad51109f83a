#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the fragments of all prisms at each texel's centre, a linked list per texel and cell. Count, or fill. One prism's fragments lie side by side in a list.
// Reads:   bin_offsets, bin_entries, triangles, raster_vertices, coverage (with kCoverage: covered texels get none)
// Writes:  RasterCounts (fragments, 64 bits per kCountBlock items), and by raster/fragments/layout.json: fragment_heads, fragments (metres, time in the cell, triangle,
//          next or kNone)
// Grid:    8 invocations per tile and cell
// Based on: Hong and Oh 2018, "Motion-blurred shadows utilizing a depth-time ranges shadow map", sections 4.1 and 4.2
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
layout(binding = 4, scalar) buffer RasterCounts { uvec2 range_counts[]; };
#include "common/prism_texels.glsl"

layout(constant_id = 4) const bool kCoverage = false;
READ_UINT(6, coverage)
#define LAYOUT_WRITE
#include "layout_interface.glsl"
#include "common/range_count.glsl"

uint total = 0u;

void visit(uint list, uint triangle, PrismFragments f) {
    if (kCoverage && fetch_coverage(params.item_first * kTileTexels + list) != kNone) return;
    uint count = uint(bitCount(f.covered));
    total += count;
    if (kPass == 0u) return;
    uint node = allocate_ranges(count);
    uint next = exchange_fragment_heads(part_first_tile() * kTileTexels + list, node);
    uint last = node + count - 1u;
    [[unroll]] for (uint i = 0u; i < kPrismTriangles; ++i) {
        if ((f.covered & (1u << i)) != 0u) {
            set_fragments(node, uvec4(floatBitsToUint(f.metres[i]), floatBitsToUint(f.time[i]), triangle, node == last ? next : node + 1u));
            ++node;
        }
    }
}

void main() {
    uint number = spread_first(params.item_count, 8u) + (gl_LocalInvocationID.x >> 3u);
    visit_texels(number);
    if (kPass == 0u) add_range_count(min(params.item_first + number, params.item_first + params.item_count - 1u) / kCountBlock, total);
}
