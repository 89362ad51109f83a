// SPDX-License-Identifier: Apache-2.0
// What the shadow tests of all methods share: their bindings, the hit in the light's view, their counters.
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
layout(constant_id = 5) const bool kFirst = false;               // Nothing was written to Lit before.
READ_UINT(0, queue)
READ_UINT(1, hits)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
READ_VEC4(4, light_vertices)
layout(binding = 5, scalar) buffer Lit { uint lit[]; };
layout(binding = 6, scalar) buffer ShadowCounts { uint shadow_counts[]; };
READ_VEC4(8, positions)
layout(binding = 7, scalar) buffer Iterators { uvec2 iterators[]; };
layout(binding = 9, scalar) buffer Ticket { uint ticket; };
READ_UINT(11, runs)
READ_UINT(12, shells)
READ_UINT(13, closed)
layout(push_constant, scalar) uniform Push { ShadowParams params; };
#include "common/ticket.glsl"
#include "common/triangle.glsl"
#include "common/batch.glsl"
#include "common/receiver.glsl"

vec4 light_vertex_at(uint vertex, Receiver h) {
    uint i = h.segment * params.camera.vertex_stride + vertex;
    vec4 a = fetch_light_vertices(i);
    vec4 b = fetch_light_vertices(i + params.camera.vertex_stride);
    return vertex_at(a, b - a, h.local_time);
}

// Is the triangle of a shell that counts as closed?
bool is_closed(uint triangle) { return fetch_closed(fetch_shells(triangle)) != 0u; }

// Metres along the hit's normal within which nothing occludes: 2^-20 of its largest coordinate, but no less than the light space's own rounding.
float occlusion_tolerance(Receiver h) {
    uint key = h.segment * params.camera.vertex_stride;
    uint next = key + params.camera.vertex_stride;
    vec3 p = vec3(0.0);
    [[unroll]] for (int k = 0; k < 3; ++k) {
        p += h.barycentrics[k] * mix(fetch_positions(key + h.vertex[k]).xyz, fetch_positions(next + h.vertex[k]).xyz, h.local_time);
    }
    return max(max_of(abs(p.x), abs(p.y), abs(p.z)) * (1.0 / 1048576.0), params.tolerance);
}

// Of the queue.
uint hit_count() { return fetch_runs(params.run_count); }

// The hit of the queue that this invocation tests; there is none from hit_count on.
uint take_hit() { return take_ticket() * gl_WorkGroupSize.x + gl_LocalInvocationIndex; }

// A hit as the light's view holds it.
struct ShadowTest {
    uint slot;
    uint own;           // The hit's triangle, which does not occlude it.
    bool reversed;      // As the camera sees it.
    bool light_reversed;
    Receiver receiver;
    vec2 at;            // Raster space of the light's view.
    uvec2 texel;
    float depth;        // In the light's view, z / w.
    float limit;        // Depth from which on nothing occludes: the hit's, less the tolerance along its normal.
    float tolerance;    // Metres.
    vec3 place;         // In the light's own space, metres.
    vec3 normal;        // There, on the light's side; its length is twice the triangle's area.
    uint list;          // Of its texel and cell of time.
    bool here;          // There is such a hit, the light may reach it, and its list is in memory.
};

// A point of raster space in the light's own space, metres: x and y across, z along the view axis.
vec3 light_place(vec4 p) {
    return vec3(p.xy * (1.0 / vec2(params.scale_x, params.scale_y)), kOrthographic ? p.z : p.w);
}

// Hit `i` of the queue.
ShadowTest shadow_test(uint i) {
    ShadowTest test;
    bool inside = i < hit_count();
    test.slot = fetch_queue(inside ? i : 0u);
    uint hit = fetch_hits(test.slot);
    test.own = hit & ~kReversed;
    test.reversed = (hit & kReversed) != 0u;
    Slot s = unpack_slot(test.slot, params.stratum_count);
    uvec2 pixel = slot_pixel(s, params.tile_first, params.camera.tiles_x);
    uint stratum = params.stratum_first + s.stratum;
    vec3 point = view_sample(false, pixel.x, pixel.y, stratum, params.stratum_length, params.seed);
    Receiver h = fetch_receiver(test.own, pixel, point, stratum, params.spp, params.camera, kStraddle, kCameraOrthographic);

    // The hit as the light's view holds it: on its own triangle at its own time.
    vec4 p0 = light_vertex_at(h.vertex.x, h);
    vec4 p1 = light_vertex_at(h.vertex.y, h);
    vec4 p2 = light_vertex_at(h.vertex.z, h);
    vec4 p = h.barycentrics.x * p0 + h.barycentrics.y * p1 + h.barycentrics.z * p2;
    test.receiver = h;
    test.at = p.xy / p.w;
    float depth = p.z / p.w;
    test.depth = depth;

    // The angle between ray and surface turns the tolerance along the normal into one in depth.
    float tolerance = occlusion_tolerance(h);
    test.tolerance = tolerance;
    bool in_cone = true;
    test.place = light_place(p);
    vec3 n = cross3(light_place(p1 - p0), light_place(p2 - p0));
    float slope = kOrthographic ? n.z : dot(n, test.place);  // Of the surface along the ray, times the length of n.
    test.light_reversed = slope < 0.0;
    test.normal = test.light_reversed ? n : -n;
    float along_ray = tolerance * sqrt(dot(n, n)) / abs(slope);
    if (kOrthographic) {
        test.limit = depth - along_ray;
    } else {
        vec3 q = test.place;
        test.limit = depth + depth * along_ray;
        in_cone = q.z > 0.0 && q.x * q.x + q.y * q.y <= q.z * q.z * params.cone_tan2;
    }

    uint tx = uint(clamp(floor(test.at.x + 0.5 * float(params.light_width)), 0.0, float(params.light_width - 1u)));
    uint ty = uint(clamp(floor(test.at.y + 0.5 * float(params.light_height)), 0.0, float(params.light_height - 1u)));
    test.texel = uvec2(tx, ty);
    uint tile = (ty / kTileSize) * ((params.light_width + kTileSize - 1u) / kTileSize) + tx / kTileSize;
    // Of tiles that are not in the window the number wraps.
    uint window_tile = tile - params.light_tile_first;
    uint cell = cell_of(h.t, params.light_cell_count);
    uint item = params.light_cell_major == 0u ? window_tile * params.light_cell_count + cell : cell * params.light_tile_count + window_tile;
    test.here = inside && in_cone && window_tile < params.light_tile_count && item >= params.item_first && item < params.item_first + params.item_count;
    test.list = item * kTileTexels + (ty & 7u) * kTileSize + (tx & 7u);
    return test;
}

// Bits that are set: the lights that reach the hit, and all that have not been asked yet.
void write_lit(uint i, ShadowTest test, bool shadowed) {
    if (kFirst) {
        if (i < hit_count()) lit[test.slot] = shadowed ? ~(1u << params.light) : 0xffffffffu;
    } else if (shadowed) {
        lit[test.slot] &= ~(1u << params.light);
    }
}

// Of methods whose visibility is a share: 0 to 1, as float bits, in a word of the slot for each light. Asked once, where the hit's list is.
void write_visibility(ShadowTest test, float visibility) {
    if (test.here) lit[test.slot] = floatBitsToUint(visibility);
}

void add_shadow_counts(uint i, uint visited, uint tested, bool was_cast) {
    uint all_visited = subgroupAdd(visited);
    uint all_tested = subgroupAdd(tested);
    uint all_cast = subgroupAdd(was_cast ? 1u : 0u);
    if (subgroupElect()) {
        uint block = (i / 65536u) * 3u;
        atomicAdd(shadow_counts[block], all_visited);
        atomicAdd(shadow_counts[block + 1u], all_tested);
        atomicAdd(shadow_counts[block + 2u], all_cast);
    }
}
