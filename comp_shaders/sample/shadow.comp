#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Exact: the candidates of the hit's texel and cell of time are tested at the hit's own light-space position and time.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Source:  math/cover.h; a hit triangle does not occlude itself, and nothing within a tolerance along its normal does (occlusion_tolerance)
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_test.glsl"
#include "common/list.glsl"
#include "common/candidates.glsl"

// Does the triangle of a range cover (x, y) at the hit's time, nearer than `limit`?
bool occludes(uint entry, Receiver h, float x, float y, float limit) {
    uvec3 v = fetch_triangles(entry & ~kReversed).xyz;
    bool reversed = (entry & kReversed) != 0u;
    vec4 p0 = light_vertex_at(v.x, h);
    vec4 p1 = light_vertex_at(reversed ? v.z : v.y, h);
    vec4 p2 = light_vertex_at(reversed ? v.y : v.z, h);
    vec3 e = edges_at(p0, p1, p2, x, y);
    float depth = kOrthographic ? depth_orthographic(e, p0, p1, p2) : depth_perspective(e, p0, p1, p2);
    return covers(e) && depth > params.depth_near && depth < limit;
}

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    Receiver h = test.receiver;

    bool shadowed = false;
    uint visited = 0u;
    uint tested = 0u;
    ListIterator it = layout_begin(test.here ? test.list : params.item_first * kTileTexels);
    if (kResume && params.part > 0u && i < hit_count()) it = iterators[i];
    // Collect candidates, then test them: two short loops instead of a loop in a loop, whose entry costs lavapipe more than a range. What is read behind a loop that
    // invocations leave at different times must be the loop's own state, tested at its top: lavapipe gives values made in the body those of the last iteration of any.
    uint steps = 0u;
    bool more = test.here && layout_more(it);
    while (more && !shadowed) {
        Candidates candidates = candidates_begin(it);
        uint count = 0u;
        while (more && count < kMostCandidates) {
            vec4 range = layout_next(it);
            bool candidate = h.t >= range.x && h.t <= range.y && range.z < test.limit && (floatBitsToUint(range.w) & ~kReversed) != test.own;
            candidates_add(candidates, count, floatBitsToUint(range.w), candidate);
            if (kCount) ++visited;
            if (kCount) tested += candidate ? 1u : 0u;
            if (kResume) ++steps;
            more = layout_more(it) && (!kResume || steps < kListChunk);
        }
        uint next = 0u;
        while (candidates_more(candidates, next, count) && !shadowed) {
            shadowed = occludes(candidates_next(candidates, next), h, test.at.x, test.at.y, test.limit);
        }
    }
    // What is shadowed has no more to walk.
    if (kResume && i < hit_count()) {
        if (shadowed) {
            it = layout_end();
        }
        iterators[i] = it;
    }
    write_lit(i, test, shadowed);
    if (kCount) add_shadow_counts(i, visited, tested, test.here);
}
