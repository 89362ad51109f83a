#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Of the hit's texel, a range of another triangle whose time includes the hit's occludes it where the depth between its
//          entry and its exit, interpolated linearly, is nearer.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Based on: Hong and Oh 2018, "Motion-blurred shadows utilizing a depth-time ranges shadow map", section 3.3
#extension GL_GOOGLE_include_directive : require
#define GN_RANGE_EXIT
#include "common/shadow_test.glsl"
#include "common/list.glsl"

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    float t = test.receiver.t;
    // Ranges hold metres along the view's axis, which a perspective view's depth is not.
    float limit = kOrthographic ? test.limit : -1.0 / test.limit;
    float metres_near = kOrthographic ? params.depth_near : -1.0 / params.depth_near;

    bool shadowed = false;
    uint visited = 0u;
    uint tested = 0u;
    ListIterator it = layout_begin(test.here ? test.list : params.item_first * kTileTexels);
    if (kResume && params.part > 0u) it = iterators[i];
    uint steps = 0u;
    bool more = test.here && layout_more(it);
    while (more) {
        float exit_depth = layout_exit_depth(it);
        vec4 range = layout_next(it);
        bool candidate = t >= range.x && t <= range.y && (floatBitsToUint(range.w) & ~kReversed) != test.own;
        float depth = mix(range.z, exit_depth, (t - range.x) / max(range.y - range.x, 1e-30));
        shadowed = shadowed || (candidate && depth > metres_near && depth < limit);
        if (kCount) ++visited;
        if (kCount) tested += candidate ? 1u : 0u;
        ++steps;
        more = layout_more(it) && !shadowed && (!kResume || steps < kListChunk);
    }
    // What is shadowed has no more to walk.
    if (kResume && i < params.hit_count) {
        if (shadowed) {
            it = layout_end();
        }
        iterators[i] = it;
    }
    write_lit(i, test, shadowed);
    if (kCount) add_shadow_counts(i, visited, tested, test.here);
}
