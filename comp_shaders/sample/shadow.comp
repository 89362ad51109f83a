#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Exact: the candidates of the hit's texel and cell of time are tested at the hit's own light-space position and time.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, shells, closed, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Source:  math/cover.h; a hit triangle does not occlude itself, and nothing within a tolerance along its normal does (occlusion_tolerance)
#extension GL_GOOGLE_include_directive : require
#define GN_SHELLS
#include "common/shadow_test.glsl"
#include "common/read_lists.glsl"
#include "common/candidates.glsl"

// Does a vertex of a triangle lie above the hit's, on the light's side? A shared one may seem to, by half a tolerance.
bool rises(vec4 p0, vec4 p1, vec4 p2, ShadowTest test) {
    Receiver h = test.receiver;
    uvec3 own = fetch_triangles(test.own).xyz;
    vec3 a = light_place(light_vertex_at(own.x, h)), b = light_place(light_vertex_at(own.y, h)), c = light_place(light_vertex_at(own.z, h));
    vec3 n = cross3(b - a, c - a);
    float slope = kOrthographic ? n.z : dot(n, a);
    // The tolerance along the normal, times the length of n: from that along the ray.
    float along_ray = kOrthographic ? test.depth - test.limit : (test.limit - test.depth) / test.depth;
    float above = 4.0 * along_ray * abs(slope);
    n = slope < 0.0 ? n : -n;
    return dot(n, light_place(p0) - a) > above || dot(n, light_place(p1) - a) > above || dot(n, light_place(p2) - a) > above;
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
        in_front = is_closed(entry & ~kReversed) && (test.behind || rises(p0, p1, p2, test));
    }
    return in_front;
}

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    float t = test.receiver.t;
    float limit = deepest(test);

    // Lit from behind a closed shell's triangle begins its way to the light inside the shell.
    bool shadowed = (!kAsked && is_inside(test)) || known_shadowed(i, test);
    uint visited = 0u;
    uint tested = 0u;
    Query query = Query(t, limit, false);
    Iterator it = walk_from(i, test, query);
    // Collect candidates, then test them: two short loops instead of a loop in a loop, whose entry costs lavapipe more than a range. What is read behind a loop that
    // invocations leave at different times must be the loop's own state, tested at its top: lavapipe gives values made in the body those of the last iteration of any.
    uint steps = 0u;
    bool more = test.here && !shadowed && layout_more(it);
    while (more && !shadowed) {
        note_round();
        Candidates candidates = no_candidates();
        while (more && candidates.count < kMostCandidates) {
            Range range = layout_next(it, query);
            bool candidate = t >= range.enter && t <= range.leave && range.depth < limit && (range.entry & ~kReversed) != test.own;
            push(candidates, range.entry, candidate);
            if (kCount) ++visited;
            if (kCount) tested += candidate ? 1u : 0u;
            if (kResume) ++steps;
            more = layout_more(it) && (!kResume || steps < kListChunk);
        }
        while (candidates.count > 0u && !shadowed) {
            shadowed = occludes(pop(candidates), test);
        }
    }
    leave_walk(i, it);
    write_lit(i, test, shadowed);
    if (kCount) add_shadow_counts(i, visited, tested, test.here);
}
