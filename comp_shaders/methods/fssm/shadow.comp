#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the share of the light that reaches the hit. Its footprint, moved to the middle of the shutter along each layer's motion, is filtered in the layer's grid; what the
//          layers let through by the variance test is multiplied.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, positions, layers, tuples, view_keys
// Writes:  Lit (per slot and light: visibility), ShadowCounts (tuples read, layers tested)
// Grid:    one invocation per hit
// Based on: Andersson et al. 2015, "Filtered stochastic shadow mapping using a layered approach", sections 4.2 and 5
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_test.glsl"
#include "common/bias.glsl"
#include "math/footprint.h"
#include "math/fssm.h"

layout(constant_id = 10) const uint kTile = 8u;           // As in methods/fssm/window.glsl, and so are the next three.
layout(constant_id = 11) const uint kWindow = 16u;
layout(constant_id = 12) const uint kGrid = 16u;
layout(constant_id = 13) const uint kLayers = 4u;
layout(constant_id = 14) const uint kLevels = 5u;        // Of a layer's grid: the filter is widened through them. 1: it is not.
layout(constant_id = 15) const bool kFootprint = true;   // Else the hit is a point in space and time.
layout(constant_id = 16) const bool kTent = true;        // The filter along v.
layout(constant_id = 17) const bool kNeighbours = true;  // Lookups near a tile's border may go to the neighbour.
layout(constant_id = 18) const bool kViewsMove = false;  // The camera or the light.
READ_VEC4(16, layers)
READ_VEC4(17, tuples)
READ_VEC4(18, view_keys)    // Per key: the camera's rows (x, y, metres) and origin, the light's (x, y, w) and origin.

// Most lookups along a footprint: the anisotropy of the hardware filter.
const uint kMostProbes = 16u;

ViewNear fetch_view(float t, uint first, vec3 p) {
    uint segment = cell_of(t, params.camera.segment_count);
    ViewRows key[2];
    [[unroll]] for (uint i = 0u; i < 2u; ++i) {
        uint at = 8u * (segment + i) + first;
        key[i] = ViewRows(vec4[3](fetch_view_keys(at), fetch_view_keys(at + 1u), fetch_view_keys(at + 2u)), fetch_view_keys(at + 3u).xyz);
    }
    return view_near(key[0], key[1], t * float(params.camera.segment_count) - float(segment), p);
}

vec3 world_of(Receiver h) {
    uint key = h.segment * params.camera.vertex_stride;
    vec3 p = vec3(0.0);
    [[unroll]] for (int k = 0; k < 3; ++k) {
        uint i = key + h.vertex[k];
        p += h.barycentrics[k] * mix(fetch_positions(i).xyz, fetch_positions(i + params.camera.vertex_stride).xyz, h.local_time);
    }
    return p;
}

// How far the point before the camera that is at p at t0 has come in the light's view by t.
vec2 drift(vec3 p, vec3 in_camera, vec3 in_light, float t) {
    vec3 offset = offset_of(fetch_view(t, 0u, p), in_camera);
    vec3 q = seen_at(fetch_view(t, 4u, p), offset);
    return q.z > 0.0 ? q.xy / q.z - in_light.xy / in_light.z : vec2(0.0);
}

// The tuple at p, in texels of the grid, bilinear; of a level that begins at `first` and is `size` texels wide.
vec4 tuple_at(vec2 p, uint first, uint size) {
    vec2 q = p * (float(size) / float(kGrid)) - 0.5;
    vec2 corner = floor(q);
    vec2 f = q - corner;
    uvec2 low = uvec2(clamp(ivec2(corner), ivec2(0), ivec2(size - 1u)));
    uvec2 high = uvec2(clamp(ivec2(corner) + 1, ivec2(0), ivec2(size - 1u)));
    vec4 above = mix(fetch_tuples(first + low.y * size + low.x), fetch_tuples(first + low.y * size + high.x), f.x);
    vec4 below = mix(fetch_tuples(first + high.y * size + low.x), fetch_tuples(first + high.y * size + high.x), f.x);
    return mix(above, below, f.y);
}

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    float t = test.receiver.t;
    float depth = biased_metres(test.depth);

    // The tile whose layers are asked.
    vec2 extent = vec2(float(params.light_size));
    vec2 place = clamp(test.at + 0.5 * extent, vec2(0.0), extent);
    uvec2 tiles = uvec2((params.light_size + kTile - 1u) / kTile);
    vec2 tile = min(floor(place / float(kTile)), vec2(tiles - 1u));
    if (kNeighbours) {
        Slot s = unpack_slot(test.slot, params.stratum_count);
        uint random = hash_pcg(pixel_hash(test.receiver.pixel.x, test.receiver.pixel.y, params.seed) ^ hash_pcg(0x85ebca6bu * (params.stratum_first + s.stratum) + params.light));
        vec2 within = place / float(kTile) - tile - 0.5;
        vec2 neighbour = tile + vec2(choose_neighbour(within.x, unit_float(random)), choose_neighbour(within.y, unit_float(hash_pcg(random))));
        tile = clamp(neighbour, vec2(0.0), vec2(tiles - 1u));
    }
    place -= (tile + 0.5) * float(kTile);
    uint tile_ix = uint(tile.y) * tiles.x + uint(tile.x);
    uint layers_in_memory = READ_COUNT(layers);
    uint layer_first = test.here ? (tile_ix - params.range_first) * kLayers : 0u;

    // Where and when the footprint begins and ends.
    float half_time = kFootprint ? 0.5 * params.stratum_length : 0.0;
    vec2 when = vec2(max(t - half_time, 0.0), min(t + half_time, 1.0));
    vec2 begin = place;
    vec2 end = place;
    if (kFootprint && kViewsMove) {
        vec3 p = world_of(test.receiver);
        vec3 in_camera = fetch_view(t, 0u, p).value;
        vec3 in_light = fetch_view(t, 4u, p).value;
        begin += drift(p, in_camera, in_light, when.x);
        end += drift(p, in_camera, in_light, when.y);
    }

    float visibility = 1.0;
    uint read = 0u;
    uint tested = 0u;
    uint k = 0u;
    while (k < kLayers) {
        vec4 layer = fetch_layers(layer_first + k);
        LayerGrid grid = layer_grid(layer.xy, float(kWindow), float(kGrid));
        vec2 a = clamp_to_grid(grid_point(grid, begin, when.x, float(kGrid)), float(kGrid));
        vec2 b = clamp_to_grid(grid_point(grid, end, when.y, float(kGrid)), float(kGrid));
        vec2 along = b - a;
        float probes = clamp(ceil(sqrt(dot(along, along))), 1.0, float(kMostProbes));
        float reach = kTent ? tent_reach(grid.motion, float(kGrid)) : 0.0;
        float rows = ceil(reach);
        bool used = test.here && layer.w < kFarthest;

        // What is read behind a loop is that loop's state, tested at its top: see sample/shadow.
        vec4 sum = vec4(0.0);
        uint size = kGrid;
        uint level_first = 0u;
        uint level = used ? 0u : kLevels;
        while (level < kLevels && !(sum.w > 0.0)) {
            float probe = 0.0;
            float row = -rows;
            while (probe < probes) {
                vec2 p = a + along * ((probe + 0.5) / probes);
                p.y += reach * row / (rows + 1.0);
                sum += (1.0 - abs(row) / (rows + 1.0)) * tuple_at(p, level_first + (layer_first + k) * size * size, size);
                if (kCount) ++read;
                row += 1.0;
                probe += row > rows ? 1.0 : 0.0;
                row = row > rows ? -rows : row;
            }
            level_first = next_level(level_first, layers_in_memory, size);
            size /= 2u;
            ++level;
        }
        float receiver = depth_at_middle(depth, layer.z, t) - layer.w;
        visibility *= used ? layer_visibility(sum, receiver) : 1.0;
        if (kCount) tested += used ? 1u : 0u;
        ++k;
    }
    write_visibility(test, clamp(visibility, 0.0, 1.0));
    if (kCount) add_shadow_counts(i, read, tested, test.here);
}
