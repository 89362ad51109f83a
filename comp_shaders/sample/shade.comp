#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: reflected light of each sample of the batch, added to the film in the order of the strata.
// Reads:   hits, lit, triangles, raster_vertices, positions, normals, attributes, materials, texels, srgb_to_linear, lights
// Writes:  Film of the window (shared/film.h), Depths (per slot, when kDepths)
// Grid:    one invocation per pixel of the batch's tiles
// Source:  Lambert; KHR_lights_punctual for the falloff of spots and point lights
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/film.h"
#include "shared/light.h"
#include "math/range.h"
#include "math/turn.h"
#include "math/unit_size.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOrthographic = false;
layout(constant_id = 1) const bool kStraddle = false;  // As in sample/trace.
layout(constant_id = 2) const bool kDepths = false;
layout(constant_id = 3) const bool kTextures = false;
layout(constant_id = 4) const bool kSmooth = false;      // Vertices have normals.
layout(constant_id = 5) const bool kLightsMove = false;
layout(constant_id = 6) const bool kFractional = false;  // Visibility is a share: see write_visibility.
READ_UINT(0, hits)
READ_UINT(1, lit)
READ_UVEC4(2, triangles)
READ_VEC4(3, raster_vertices)
READ_VEC4(4, positions)
READ_VEC4(5, normals)
READ_VEC4(6, attributes)
READ_UVEC4(7, materials)
READ_UVEC4(8, texels)
READ_FLOAT(9, srgb_to_linear)
READ_VEC4(10, lights)
layout(binding = 11, scalar) buffer Film { float film[]; };
layout(binding = 12, scalar) writeonly buffer Depths { float depths[]; };
layout(push_constant, scalar) uniform Push { ShadeParams params; };
#include "common/triangle.glsl"
#include "common/batch.glsl"
#include "common/receiver.glsl"
#include "common/texture.glsl"

vec3 blend(vec3 a, vec3 b, vec3 c, vec3 weights) { return weights.x * a + weights.y * b + weights.z * c; }

vec3 position_at(uint vertex, Receiver h) {
    uint i = h.segment * params.grid.vertex_stride + vertex;
    return mix(fetch_positions(i).xyz, fetch_positions(i + params.grid.vertex_stride).xyz, h.local_time);
}

vec3 normal_at(uint vertex, Receiver h) {
    uint i = h.segment * params.grid.vertex_stride + vertex;
    return mix(fetch_normals(i).xyz, fetch_normals(i + params.grid.vertex_stride).xyz, h.local_time);
}

// -Z of a frame turned by the quaternion.
vec3 forward_of(vec4 q) {
    return -vec3(2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
}

// Incoming light times cosine, without visibility.
vec3 incoming(uint light, Receiver h, vec3 position, vec3 normal) {
    uint head = light_record(light, params.key_count);
    vec4 color_kind = fetch_lights(head);
    vec4 cone = fetch_lights(head + 1u);
    uint key = light_key(light, h.segment, params.key_count);
    vec4 place = fetch_lights(key);
    vec3 origin = place.xyz;
    vec4 rotation = fetch_lights(key + 1u);
    if (kLightsMove) {
        origin = mix(origin, fetch_lights(key + 2u).xyz, h.local_time);
        rotation = turn_between(rotation, fetch_lights(key + 3u), place.w, h.local_time);
    }
    vec3 axis = forward_of(rotation);
    bool spot = floatBitsToUint(color_kind.w) == kLightSpot;
    vec3 to_light = spot ? origin - position : -axis;
    float distance2 = max(dot(to_light, to_light), 1e-12);
    vec3 l = to_light * inversesqrt(distance2);
    float cone_factor = clamp(-dot(axis, l) * cone.x + cone.y, 0.0, 1.0);
    float ratio2 = cone.z > 0.0 ? distance2 / (cone.z * cone.z) : 0.0;
    float window = clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
    float falloff = spot ? cone_factor * cone_factor * window / distance2 : 1.0;
    return color_kind.xyz * (falloff * max(dot(normal, l), 0.0));
}

// The share of the light that reaches the hit at `place`.
float visibility(uint place, uint light) {
    uint word = fetch_lit((kFractional ? light : lit_word(light)) * params.lit_stride + place);
    return kFractional ? uintBitsToFloat(word) : float((word >> lit_bit(light)) & 1u);
}

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    ViewGrid grid = params.grid;
    bool inside = i < params.tile_count * kTileTexels;
    uint tile_in_batch = min(i / kTileTexels, params.tile_count - 1u);
    uint texel = i & (kTileTexels - 1u);
    Slot slot = Slot(tile_in_batch, 0u, slot_row(texel), slot_column(texel));
    uvec2 pixel = slot_pixel(slot, params.tile_first, grid.tiles_x);
    inside = inside && pixel.x < grid.width && pixel.y < grid.height;

    // The sums go on from the film's, one sample at a time, so that they do not depend on how the strata are split into batches.
    uint plane = params.film_pixels;
    uint first_row = divide(grid.tile_first, grid.tiles_x);
    uvec2 film_first = uvec2(grid.tile_first - first_row * grid.tiles_x, first_row) * kTileSize;
    uint at = inside ? (pixel.y - film_first.y) * params.film_width + pixel.x - film_first.x : 0u;
    vec3 color = vec3(film[kFilmRed * plane + at], film[kFilmGreen * plane + at], film[kFilmBlue * plane + at]);
    float hit_count = film[kFilmHits * plane + at];
    float depth_sum = film[kFilmDepth * plane + at];
    uint s = inside ? 0u : params.stratum_count;
    while (s < params.stratum_count) {
        // On to the next sample that hit something, so that all invocations of a subgroup shade. Tested at the loop's top: see sample/shadow.
        uint place = 0u;
        uint entry = kNone;
        while (entry == kNone && s < params.stratum_count) {
            place = (tile_in_batch * params.stratum_count + s) * kTileTexels + texel;
            entry = fetch_hits(place);
            ++s;
        }
        if (entry != kNone) {
            uint stratum = params.stratum_first + s - 1u;
            vec3 point = view_sample(false, pixel.x, pixel.y, stratum, params.stratum_length, params.seed);
            Receiver h = fetch_receiver(entry, pixel, point, stratum, params.spp, grid, kStraddle, kOrthographic);
            vec3 w0 = position_at(h.vertex.x, h), w1 = position_at(h.vertex.y, h), w2 = position_at(h.vertex.z, h);
            vec3 position = blend(w0, w1, w2, h.barycentrics);
            // Seen in positive orientation, the normal of the triangle's own winding points away from the camera.
            vec3 geometric = normalize(unit_size(cross3(w1 - w0, w2 - w0))) * ((entry & kReversed) != 0u ? 1.0 : -1.0);
            vec3 normal = geometric;
            if (kSmooth) {
                vec3 blended = blend(normal_at(h.vertex.x, h), normal_at(h.vertex.y, h), normal_at(h.vertex.z, h), h.barycentrics);
                float length2 = dot(blended, blended);
                normal = length2 > 1e-20 ? blended * inversesqrt(length2) : geometric;
                normal = dot(normal, geometric) < 0.0 ? -normal : normal;
            }

            uint a0 = 2u * h.vertex.x, a1 = 2u * h.vertex.y, a2 = 2u * h.vertex.z;
            vec3 tint = blend(fetch_attributes(a0 + 1u).xyz, fetch_attributes(a1 + 1u).xyz, fetch_attributes(a2 + 1u).xyz, h.barycentrics);
            vec3 albedo = tint * uintBitsToFloat(fetch_materials(2u * h.material).xyz);
            if (kTextures) {
                uvec4 image = fetch_materials(2u * h.material + 1u);
                vec2 uv = blend(fetch_attributes(a0).xyz, fetch_attributes(a1).xyz, fetch_attributes(a2).xyz, h.barycentrics).xy;
                bool textured = image.x != kNone;
                vec4 sampled = sample_texture(textured ? image : uvec4(0u, 1u, 1u, 0u), uv);
                albedo *= textured ? sampled.xyz : vec3(1.0);
            }
            for (uint light = 0u; light < params.light_count; ++light) {
                vec3 arriving = incoming(light, h, position, normal);
                color += visibility(place, light) * albedo * arriving * (1.0 / 3.14159265358979);
            }
            float metres = kOrthographic ? h.depth : -1.0 / h.depth;
            hit_count += 1.0;
            depth_sum += metres;
            if (kDepths) depths[place] = metres;
        }
    }
    if (inside) {
        film[kFilmRed * plane + at] = color.x;
        film[kFilmGreen * plane + at] = color.y;
        film[kFilmBlue * plane + at] = color.z;
        film[kFilmHits * plane + at] = hit_count;
        film[kFilmDepth * plane + at] = depth_sum;
    }
    for (uint light = 0u; light < params.light_count; ++light) {
        uint sums = film_visibility(light) * plane + at, squares = sums + plane;
        float sum = film[sums];
        float sum_of_squares = kFractional ? film[squares] : 0.0;
        uint stratum = 0u;
        do {
            uint place = (tile_in_batch * params.stratum_count + stratum) * kTileTexels + texel;
            float visible = fetch_hits(place) != kNone ? visibility(place, light) : 0.0;
            sum += visible;
            sum_of_squares += visible * visible;
            ++stratum;
        } while (stratum < params.stratum_count);
        if (inside) film[sums] = sum;
        if (inside && kFractional) film[squares] = sum_of_squares;
    }
}
