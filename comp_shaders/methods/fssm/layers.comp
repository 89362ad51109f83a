#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: cut the samples in a tile's window into layers of depth at the middle of the shutter, and find each layer's mean motion.
// Reads:   map_samples
// Writes:  Layers (per tile and layer: motion in x, y and depth; the layer's far end)
// Grid:    one workgroup per tile
// Based on: Andersson et al. 2015, "Filtered stochastic shadow mapping using a layered approach", section 4.1
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
READ_VEC4(0, map_samples)
layout(binding = 1, scalar) writeonly buffer Layers { vec4 layers[]; };
layout(push_constant, scalar) uniform Push { FssmParams params; };
#include "common/batch.glsl"
#include "methods/fssm/window.glsl"

shared vec2 s_range[64];
shared uvec2 s_occupied[64];
shared vec4 s_motion[kMostLayers][64];  // Sums, and how many.

// Of a number from 0 to kWindow^2 - 1.
WindowTexel texel_of(uvec2 tile, uint i) {
    uint y = divide(i, kWindow);
    return window_texel(tile, i - y * kWindow, y);
}

void main() {
    uint local = group_index();
    bool inside = local < params.tile_count;
    uint tile_ix = params.tile_first + (inside ? local : 0u);
    uint tile_y = divide(tile_ix, params.tiles_x);
    uvec2 tile = uvec2(tile_ix - tile_y * params.tiles_x, tile_y);
    uint lane = gl_LocalInvocationIndex;
    uint end = params.stratum_first + params.stratum_count;

    vec2 range = vec2(kFarthest, -kFarthest);
    for (uint i = lane; i < kWindow * kWindow; i += 64u) {
        WindowTexel texel = texel_of(tile, i);
        for (uint stratum = params.stratum_first; stratum < end; ++stratum) {
            WindowSample w = window_sample(texel, tile, stratum);
            float depth = depth_at_middle(w.depth, w.motion.z, w.t);
            range.x = w.hit ? min(range.x, depth) : range.x;
            range.y = w.hit ? max(range.y, depth) : range.y;
        }
    }
    s_range[lane] = range;
    for (uint half_count = 32u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (lane < half_count) s_range[lane] = vec2(min(s_range[lane].x, s_range[lane + half_count].x), max(s_range[lane].y, s_range[lane + half_count].y));
    }
    barrier();
    range = s_range[0];

    uvec2 occupied = uvec2(0u);
    for (uint i = lane; i < kWindow * kWindow; i += 64u) {
        WindowTexel texel = texel_of(tile, i);
        for (uint stratum = params.stratum_first; stratum < end; ++stratum) {
            WindowSample w = window_sample(texel, tile, stratum);
            uint interval = interval_of(depth_at_middle(w.depth, w.motion.z, w.t), range.x, range.y);
            occupied = w.hit ? with_interval(occupied, interval) : occupied;
        }
    }
    s_occupied[lane] = occupied;
    for (uint half_count = 32u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (lane < half_count) s_occupied[lane] |= s_occupied[lane + half_count];
    }
    barrier();
    bool any_hit = range.x <= range.y;
    vec4 ends = any_hit ? split_layers(s_occupied[0], range.x, range.y, kLayers) : vec4(kFarthest);

    vec4 sums[kMostLayers];
    [[unroll]] for (uint k = 0u; k < kMostLayers; ++k) sums[k] = vec4(0.0);
    for (uint i = lane; i < kWindow * kWindow; i += 64u) {
        WindowTexel texel = texel_of(tile, i);
        for (uint stratum = params.stratum_first; stratum < end; ++stratum) {
            WindowSample w = window_sample(texel, tile, stratum);
            uint layer = layer_of(depth_at_middle(w.depth, w.motion.z, w.t), ends);
            [[unroll]] for (uint k = 0u; k < kMostLayers; ++k) sums[k] += w.hit && layer == k ? vec4(w.motion, 1.0) : vec4(0.0);
        }
    }
    [[unroll]] for (uint k = 0u; k < kMostLayers; ++k) s_motion[k][lane] = sums[k];
    for (uint half_count = 32u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (lane < half_count) {
            [[unroll]] for (uint k = 0u; k < kMostLayers; ++k) s_motion[k][lane] += s_motion[k][lane + half_count];
        }
    }
    barrier();
    if (lane < kLayers && inside) {
        vec4 sum = s_motion[lane][0];
        layers[params.layer_first + local * kLayers + lane] = vec4(sum.xyz / max(sum.w, 1.0), ends[lane]);
    }
}
