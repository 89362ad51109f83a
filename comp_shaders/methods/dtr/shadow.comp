#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Not where a range of its texel occludes it (methods/dtr/ranges.glsl).
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Based on: Hong and Oh 2018, "Motion-blurred shadows utilizing a depth-time ranges shadow map", section 3.3
#extension GL_GOOGLE_include_directive : require
#define GN_RANGE_EXIT
#include "common/shadow_test.glsl"
#include "common/read_lists.glsl"
#include "methods/dtr/ranges.glsl"

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    uint visited = 0u;
    uint tested = 0u;
    bool shadowed = occluded_by_ranges(i, test, true, visited, tested);
    write_lit(i, test, shadowed);
    if (kCount) add_shadow_counts(i, visited, tested, test.here);
}
