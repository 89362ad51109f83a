#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: which triangle covers a texel's centre for the whole of its segment, with nothing nearer. Four passes: the depth of the nearest fragment; its triangle (the
//          lowest, of equally near ones), which with the depth is the nearest map; the triangle covers the texel if its nearest fragment and another one are a whole
//          segment apart, and its depth becomes the other one's; where another prism has a fragment nearer than that, nothing covers it.
// Reads:   bin_offsets, bin_entries, triangles, raster_vertices
// Writes:  NearestDepths (ordered bits, math/order.h), NearestTriangles, Coverage (triangle or kNone), per list
// Grid:    8 invocations per tile and cell
// Based on: Hong and Oh 2017, Extension; its second pass writes depth untested, so that its third, which tests it, meets the depth where the covering triangle goes
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "common/prism_texels.glsl"
#include "math/order.h"

layout(binding = 16, scalar) buffer NearestDepths { uint nearest_depths[]; };
layout(binding = 17, scalar) buffer NearestTriangles { uint nearest_triangles[]; };
layout(binding = 18, scalar) buffer Coverage { uint coverage[]; };

void visit(uint list, uint triangle, PrismFragments f) {
    float depth = kFarthest, time = 0.0;
    [[unroll]] for (uint i = 0u; i < kPrismTriangles; ++i) {
        bool nearer = (f.covered & (1u << i)) != 0u && f.metres[i] < depth;
        depth = nearer ? f.metres[i] : depth;
        time = nearer ? f.time[i] : time;
    }
    uint key = ordered_bits(depth);
    if (kPass == 0u) atomicMin(nearest_depths[list], key);
    if (kPass == 1u && key == nearest_depths[list]) atomicMin(nearest_triangles[list], triangle);
    if (kPass == 2u && triangle == nearest_triangles[list]) {
        bool whole = false;
        float other = 0.0;
        [[unroll]] for (uint i = 0u; i < kPrismTriangles; ++i) {
            bool opposite = (f.covered & (1u << i)) != 0u && abs(f.time[i] - time) >= 1.0;
            whole = whole || opposite;
            other = opposite ? f.metres[i] : other;
        }
        if (whole) {
            coverage[list] = triangle;
            nearest_depths[list] = ordered_bits(other);
        }
    }
    if (kPass == 3u) {
        uint covering = coverage[list];
        if (covering != kNone && covering != triangle && key < nearest_depths[list]) atomicMax(coverage[list], kNone);
    }
}

void main() { visit_texels(spread_first(params.item_count, 8u) + (gl_LocalInvocationID.x >> 3u)); }
