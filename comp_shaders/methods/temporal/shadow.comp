#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Where a triangle covers the hit's texel for the whole segment, it reaches that triangle and no other; elsewhere it is
//          the ranges that say so (methods/dtr/ranges.glsl).
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, coverage, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Based on: Hong and Oh 2017, Extension, Final_Shadow_Test
#extension GL_GOOGLE_include_directive : require
#define GN_RANGE_EXIT
#include "common/shadow_test.glsl"
#include "common/read_lists.glsl"
#include "methods/dtr/ranges.glsl"

READ_UINT(10, coverage)

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    uint covering = test.here ? fetch_coverage(test.list) : kNone;
    bool covered = covering != kNone;
    uint visited = 0u;
    uint tested = 0u;
    bool occluded = occluded_by_ranges(i, test, !covered, visited, tested);
    write_lit(i, test, covered ? covering != test.own : occluded);
    if (kCount) add_shadow_counts(i, visited, tested, test.here);
}
