#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Exact: the candidates of the hit's texel and cell of time are tested at the hit's own light-space position and time.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, shells, closed, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Source:  math/cover.h; a hit triangle does not occlude itself, and nothing within a tolerance along its normal does (occlusion_tolerance)
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_test.glsl"
#include "common/list.glsl"
#include "common/candidates.glsl"
layout(constant_id = 6) const bool kOneSide = false;  // Of closed shells the lists hold only what looks away from the light.

// Does a vertex lie above the hit's triangle, on the light's side? A shared one may seem to, by half a tolerance.
bool rises(vec4 p, ShadowTest test) {
    return dot(test.normal, light_place(p) - test.place) > 4.0 * test.tolerance * sqrt(dot(test.normal, test.normal));
}

// Camera and light see different sides of the hit's triangle.
bool lit_from_behind(ShadowTest test) { return test.reversed != test.light_reversed; }

// Depth from which on nothing of what is listed occludes the hit.
float deepest(ShadowTest test) {
    float tolerance = test.depth - test.limit;
    return !kOneSide ? test.limit : (lit_from_behind(test) ? test.depth + 8.0 * tolerance : test.depth);
}

// Does the triangle of a range occlude the hit?
bool occludes(uint entry, ShadowTest test) {
    Receiver h = test.receiver;
    uvec3 v = fetch_triangles(entry & ~kReversed).xyz;
    bool reversed = (entry & kReversed) != 0u;
    vec4 p0 = light_vertex_at(v.x, h);
    vec4 p1 = light_vertex_at(reversed ? v.z : v.y, h);
    vec4 p2 = light_vertex_at(reversed ? v.y : v.z, h);
    vec3 e = edges_at(p0, p1, p2, test.at.x, test.at.y);
    float depth = kOrthographic ? depth_orthographic(e, p0, p1, p2) : depth_perspective(e, p0, p1, p2);
    bool in_front = covers(e) && depth > params.depth_near && depth < deepest(test);
    if (kOneSide && in_front && !(depth < test.limit)) {
        // Where the ray enters a closed shell within the tolerance it leaves it farther on, through a face that is not listed. The tolerance is there for the hit's
        // neighbours, which at a silhouette lie below its triangle: what rises above it occludes, however near it is. A triangle that is lit from behind is of no
        // closed shell, hence none's neighbour: what lies on its back occludes.
        in_front = is_closed(entry & ~kReversed) && (lit_from_behind(test) || rises(p0, test) || rises(p1, test) || rises(p2, test));
    }
    return in_front;
}

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    float t = test.receiver.t;
    float limit = deepest(test);

    // Lit from behind a closed shell's triangle begins its way to the light inside the shell.
    bool shadowed = kOneSide && test.here && lit_from_behind(test) && is_closed(test.own);
    uint visited = 0u;
    uint tested = 0u;
    ListIterator it = layout_begin(test.here ? test.list : params.item_first * kTileTexels);
    if (kResume && params.part > 0u) it = iterators[i];
    // Collect candidates, then test them: two short loops instead of a loop in a loop, whose entry costs lavapipe more than a range. What is read behind a loop that
    // invocations leave at different times must be the loop's own state, tested at its top: lavapipe gives values made in the body those of the last iteration of any.
    uint steps = 0u;
    bool more = test.here && !shadowed && layout_more(it);
    while (more && !shadowed) {
        Candidates candidates = candidates_begin(it);
        uint count = 0u;
        while (more && count < kMostCandidates) {
            vec4 range = layout_next(it);
            bool candidate = t >= range.x && t <= range.y && range.z < limit && (floatBitsToUint(range.w) & ~kReversed) != test.own;
            candidates_add(candidates, count, floatBitsToUint(range.w), candidate);
            if (kCount) ++visited;
            if (kCount) tested += candidate ? 1u : 0u;
            if (kResume) ++steps;
            more = layout_more(it) && (!kResume || steps < kListChunk);
        }
        uint next = 0u;
        while (candidates_more(candidates, next, count) && !shadowed) {
            shadowed = occludes(candidates_next(candidates, next), test);
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
