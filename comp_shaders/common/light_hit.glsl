// SPDX-License-Identifier: Apache-2.0
// A hit of the queue as a light's view holds it: what the shadow tests of all methods begin with. It is found again from its sample. With GN_SHELLS defined: what of it
// knows closed shells.
#include "common/stage.glsl"
#include "shared/light.h"
#include "math/face.h"
#include "math/range.h"
#include "math/unit_size.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kLightView = kPerspectiveView;
layout(constant_id = 1) const bool kCameraOrthographic = false;
layout(constant_id = 2) const bool kStraddle = false;            // As in sample/trace.
layout(constant_id = 3) const bool kOneSide = false;             // Of closed shells the lists hold only what looks away from the light.
READ_UINT(0, queue)
READ_UINT(1, hits)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
READ_VEC4(4, light_vertices)
READ_VEC4(8, positions)
READ_UINT(11, runs)
#ifdef GN_SHELLS
READ_UINT(12, shells)
READ_UINT(13, closed)
#endif
READ_VEC4(41, lights)
const bool kOrthographic = kLightView == kOrthographicView;
const bool kFaces = kLightView == kFaceView;
layout(push_constant, scalar) uniform Push { ShadowParams params; };
#include "common/spread.glsl"
#include "common/triangle.glsl"
#include "common/batch.glsl"
#include "common/receiver.glsl"

vec4 light_vertex_at(uint vertex, Receiver h) {
    uint i = h.segment * params.camera.vertex_stride + vertex;
    vec4 a = fetch_light_vertices(i);
    vec4 b = fetch_light_vertices(i + params.camera.vertex_stride);
    return vertex_at(a, b - a, h.local_time);
}

#ifdef GN_SHELLS
// Is the triangle of a shell that counts as closed?
bool is_closed(uint triangle) { return fetch_closed(fetch_shells(triangle)) != 0u; }
#endif

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

// Turned back by a unit quaternion (x, y, z, w).
vec3 unturned(vec4 q, vec3 v) { return v + 2.0 * cross3(q.xyz, cross3(q.xyz, v) - q.w * v); }

// From the light toward the hit, of any length, in the light's own frame at the keys and linear between them, as its faces' views are. The same for all of them, to the bit:
// Vulkan leaves no choice in sums and products.
vec3 from_light(Receiver h) {
    uint record = light_key(params.light, h.segment, params.camera.segment_count + 1u);
    vec3 origin = fetch_lights(record).xyz, next_origin = fetch_lights(record + 2u).xyz;
    vec4 rotation = fetch_lights(record + 1u), next_rotation = fetch_lights(record + 3u);
    uint key = h.segment * params.camera.vertex_stride;
    uint next = key + params.camera.vertex_stride;
    vec3 d = vec3(0.0);
    [[unroll]] for (int k = 0; k < 3; ++k) {
        vec3 a = unturned(rotation, fetch_positions(key + h.vertex[k]).xyz - origin);
        vec3 b = unturned(next_rotation, fetch_positions(next + h.vertex[k]).xyz - next_origin);
        d += h.edges[k] * (a + h.local_time * (b - a));
    }
    return h.edges.x + h.edges.y + h.edges.z < 0.0 ? -d : d;
}

// Is it this face that the hit belongs to, and does the light shine there?
bool on_face(Receiver h) {
    vec3 d = from_light(h);
    return face_of(d) == params.face && -d.z >= params.cone * sqrt(dot(d, d));
}

// Of the queue.
uint hit_count() { return fetch_runs(params.run_count); }

// The hit of the queue that this invocation tests; there is none from hit_count on.
uint take_hit() { return spread_first(hit_count(), gl_WorkGroupSize.x) + gl_LocalInvocationIndex; }

// A hit as the light's view holds it.
struct ShadowTest {
    uint slot;
    uint own;           // The hit's triangle, which does not occlude it.
    Receiver receiver;
    vec2 at;            // Raster space of the light's view.
    uvec2 texel;
    float depth;        // In the light's view, z / w.
    float limit;        // Depth from which on nothing occludes: the hit's, less the tolerance along its normal.
    bool behind;        // Camera and light see different sides of its triangle.
    uint item;          // Its tile of the window and cell of time.
    uint list;          // Of its texel and cell of time.
    bool here;          // There is such a hit, the light may reach it, and its list is in memory.
};

// Of a level of pages, whose texels have a 2^level-th of the view's texels' side.
uvec2 texel_at(vec2 at, uint level) {
    float size = float(params.light_size), scale = float(1u << level);
    return uvec2(clamp(floor((at + 0.5 * size) * scale), 0.0, size * scale - 1.0));
}

bool in_memory(uint item) { return item >= params.item_first && item < params.item_first + params.item_count; }

uint list_of(uint item, uvec2 texel) { return item * kTileTexels + (texel.y & 7u) * kTileSize + (texel.x & 7u); }

// A point of raster space in the light's own space, metres: x and y across, z along the view axis.
vec3 light_place(vec4 p) {
    return vec3(p.xy * (1.0 / vec2(params.scale_x, params.scale_y)), kOrthographic ? p.z : p.w);
}

#ifdef GN_SHELLS
// Inside a closed shell, which it lights from behind: dark.
bool is_inside(ShadowTest test) { return kOneSide && test.here && test.behind && is_closed(test.own); }
#endif

// Depth from which on nothing of what is listed occludes the hit.
float deepest(ShadowTest test) {
    return !kOneSide ? test.limit : (test.behind ? test.depth + 8.0 * (test.depth - test.limit) : test.depth);
}

// Hit `i` of the queue.
ShadowTest find_hit(uint i) {
    ShadowTest test;
    bool inside = i < hit_count();
    test.slot = fetch_queue(inside ? i : 0u);
    uint hit = fetch_hits(test.slot);
    test.own = hit & ~kReversed;
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
    if (kFaces) {
        // By rounding a hit may lie beyond the face that it belongs to, where nothing is listed.
        float border = 0.5 * float(params.light_size);
        test.at = clamp(test.at, -border, border);
    }
    float depth = p.z / p.w;
    test.depth = depth;

    // The angle between ray and surface turns the tolerance along the normal into one in depth.
    vec3 place = light_place(p);
    vec3 n = unit_size(cross3(light_place(p1 - p0), light_place(p2 - p0)));
    float slope = kOrthographic ? n.z : dot(n, place);  // Of the surface along the ray, times the length of n.
    test.behind = ((hit & kReversed) != 0u) != (slope < 0.0);
    float along_ray = occlusion_tolerance(h) * sqrt(dot(n, n)) / abs(slope);
    test.limit = kOrthographic ? depth - along_ray : depth + depth * along_ray;
    bool in_cone = kOrthographic || (place.z > 0.0 && place.x * place.x + place.y * place.y <= place.z * place.z * params.cone);
    if (kFaces) in_cone = place.z > 0.0 && on_face(h);

    // Beyond the view nothing is listed, nor at its border.
    bool in_view = max(abs(test.at.x), abs(test.at.y)) <= 0.5 * float(params.light_size) + 1.0;

    test.texel = texel_at(test.at, 0u);
    uint tile = (test.texel.y / kTileSize) * ((params.light_size + kTileSize - 1u) / kTileSize) + test.texel.x / kTileSize;
    // Of tiles that are not in the window the number wraps.
    uint window_tile = tile - params.light_tile_first;
    uint cell = cell_of(h.t, params.light_cell_count);
    test.item = params.light_cell_major == 0u ? window_tile * params.light_cell_count + cell : cell * params.light_tile_count + window_tile;
    test.here = inside && in_cone && in_view && window_tile < params.light_tile_count && in_memory(test.item);
    test.list = list_of(test.item, test.texel);
    return test;
}

