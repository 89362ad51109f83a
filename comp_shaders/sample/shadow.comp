#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Exact: the candidates of the hit's texel and cell of time are tested at the hit's own light-space position and time.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, the layout's buffers
// Writes:  Lit (per slot: bit `light`), ShadowCounts (ranges visited, ranges tested), Iterators (when lists are walked in parts)
// Grid:    one invocation per hit
// Source:  math/cover.h; a hit triangle does not occlude itself, and nothing within `tolerance` of the hit along its normal does
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "math/range.h"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOrthographic = false;        // The light's view.
layout(constant_id = 1) const bool kCameraOrthographic = false;
layout(constant_id = 2) const bool kStraddle = false;            // As in sample/trace.
layout(constant_id = 3) const bool kCount = false;               // Fill ShadowCounts.
layout(constant_id = 4) const bool kResume = false;              // Lists are walked in parts of kListChunk.
layout(binding = 0) uniform usamplerBuffer queue;
layout(binding = 1) uniform usamplerBuffer hits;
layout(binding = 2) uniform usamplerBuffer triangles;
layout(binding = 3) uniform samplerBuffer raster_vertices;
layout(binding = 4) uniform samplerBuffer light_vertices;
layout(binding = 5, scalar) buffer Lit { uint lit[]; };
layout(binding = 6, scalar) buffer ShadowCounts { uint shadow_counts[]; };
layout(binding = 7, scalar) buffer Iterators { uvec2 iterators[]; };
layout(push_constant, scalar) uniform Push { ShadowParams params; };
#include "common/triangle.glsl"
#include "common/batch.glsl"
#include "common/receiver.glsl"
uint range_base() { return params.range_first; }
#define ListIterator uvec2
#define LAYOUT_READ
#include "layout.glsl"

vec4 light_vertex_at(uint vertex, Receiver h) {
    int i = int(h.segment * params.camera.vertex_stride + vertex);
    vec4 a = texelFetch(light_vertices, i);
    vec4 b = texelFetch(light_vertices, i + int(params.camera.vertex_stride));
    return vertex_at(a, b - a, h.local_time);
}

// Does the triangle of a range cover (x, y) at the hit's time, nearer than `limit`?
bool occludes(uint entry, Receiver h, float x, float y, float limit) {
    uvec3 v = texelFetch(triangles, int(entry & ~kReversed)).xyz;
    bool reversed = (entry & kReversed) != 0u;
    vec4 p0 = light_vertex_at(v.x, h);
    vec4 p1 = light_vertex_at(reversed ? v.z : v.y, h);
    vec4 p2 = light_vertex_at(reversed ? v.y : v.z, h);
    vec3 e = edges_at(p0, p1, p2, x, y);
    float depth = kOrthographic ? depth_orthographic(e, p0, p1, p2) : depth_perspective(e, p0, p1, p2);
    return covers(e) && depth > params.depth_near && depth < limit;
}

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = i < params.hit_count;
    uint slot = texelFetch(queue, int(min(i, params.hit_count - 1u))).x;
    uint own = texelFetch(hits, int(slot)).x & ~kReversed;
    Slot s = unpack_slot(slot, params.stratum_count);
    uvec2 pixel = slot_pixel(s, params.tile_first, params.camera.tiles_x);
    Receiver h = fetch_receiver(own, pixel, params.stratum_first + s.stratum, params.spp, params.seed, params.camera, kStraddle, kCameraOrthographic);

    // The hit as the light's view holds it: on its own triangle at its own time.
    vec4 p0 = light_vertex_at(h.vertex.x, h);
    vec4 p1 = light_vertex_at(h.vertex.y, h);
    vec4 p2 = light_vertex_at(h.vertex.z, h);
    vec4 p = h.barycentrics.x * p0 + h.barycentrics.y * p1 + h.barycentrics.z * p2;
    float x = p.x / p.w;
    float y = p.y / p.w;
    float depth = p.z / p.w;

    // In the light's own space, metres: the angle between ray and surface turns the tolerance along the normal into one in depth.
    vec2 scale = 1.0 / vec2(params.scale_x, params.scale_y);
    vec4 u = p1 - p0, v = p2 - p0;
    float limit;
    bool in_cone = true;
    if (kOrthographic) {
        vec3 n = cross3(vec3(u.xy * scale, u.z), vec3(v.xy * scale, v.z));
        limit = depth - params.tolerance * sqrt(dot(n, n)) / abs(n.z);
    } else {
        vec3 q = vec3(p.xy * scale, p.w);
        vec3 n = cross3(vec3(u.xy * scale, u.w), vec3(v.xy * scale, v.w));
        limit = depth + depth * (params.tolerance * sqrt(dot(n, n)) / abs(dot(n, q)));
        in_cone = q.z > 0.0 && q.x * q.x + q.y * q.y <= q.z * q.z * params.cone_tan2;
    }

    uint tx = uint(clamp(floor(x + 0.5 * float(params.light_width)), 0.0, float(params.light_width - 1u)));
    uint ty = uint(clamp(floor(y + 0.5 * float(params.light_height)), 0.0, float(params.light_height - 1u)));
    uint item = ((ty / kTileSize) * params.light_tiles_x + tx / kTileSize) * params.light_cell_count + cell_of(h.t, params.light_cell_count);
    bool here = inside && in_cone && item >= params.item_first && item < params.item_first + params.item_count;
    uint list = item * kTileTexels + (ty & 7u) * kTileSize + (tx & 7u);

    bool shadowed = false;
    uint visited = 0u;
    uint tested = 0u;
    ListIterator it = layout_begin(here ? list : params.item_first * kTileTexels);
    if (kResume && params.part > 0u) it = iterators[i];
    uint steps = 0u;
    bool more = here && layout_more(it);
    while (more) {
        // Walk to the next candidate of each invocation, then test all of them together. What is read behind a loop that invocations leave at different times must
        // be the loop's own state, tested at its top: lavapipe gives values made in the body those of the last iteration of any invocation.
        bool searching = true;
        bool candidate = false;
        uint entry = 0u;
        while (searching) {
            vec4 range = layout_next(it);
            entry = floatBitsToUint(range.w);
            candidate = h.t >= range.x && h.t <= range.y && range.z < limit && (entry & ~kReversed) != own;
            if (kCount) ++visited;
            if (kResume) ++steps;
            more = layout_more(it) && (!kResume || steps < kListChunk);
            searching = more && !candidate;
        }
        shadowed = candidate && occludes(entry, h, x, y, limit);
        if (kCount) tested += candidate ? 1u : 0u;
        more = more && !shadowed;
    }
    // What is shadowed has no more to walk.
    if (kResume && inside) {
        if (shadowed) {
            it = layout_end();
        }
        iterators[i] = it;
    }
    if (shadowed) lit[slot] &= ~(1u << params.light);
    if (kCount) {
        uint all_visited = subgroupAdd(visited);
        uint all_tested = subgroupAdd(tested);
        uint all_cast = subgroupAdd(here ? 1u : 0u);
        if (subgroupElect()) {
            uint block = (i / 65536u) * 3u;
            atomicAdd(shadow_counts[block], all_visited);
            atomicAdd(shadow_counts[block + 1u], all_tested);
            atomicAdd(shadow_counts[block + 2u], all_cast);
        }
    }
}
