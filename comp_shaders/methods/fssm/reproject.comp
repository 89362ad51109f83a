#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: move the samples of a tile's window along each layer's mean motion to the middle of the shutter and add them up on the layer's grid: sums of w a z, w a z^2, w a
//          and w, where w is 1 for what is in or behind the layer, a is 1 for what is in it, and z is measured from the layer's far end.
// Reads:   map_samples, layers
// Writes:  Tuples (per tile, layer and texel of the grid, rows from the top), to which it adds
// Grid:    one invocation per tile, so that sums have one order
// Based on: Andersson et al. 2015, "Filtered stochastic shadow mapping using a layered approach", section 4.1, eq. 6 and 7
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer map_samples;
layout(binding = 1) uniform samplerBuffer layers;
layout(binding = 2, scalar) buffer Tuples { float tuples[]; };
layout(push_constant, scalar) uniform Push { FssmParams params; };
#include "common/batch.glsl"
#include "methods/fssm/window.glsl"

void main() {
    uint local = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = local < params.tile_count;
    local = inside ? local : 0u;
    uint tile_ix = params.tile_first + local;
    uint tile_y = divide(tile_ix, params.tiles_x);
    uvec2 tile = uvec2(tile_ix - tile_y * params.tiles_x, tile_y);

    vec4 layer[kMostLayers];
    LayerGrid grid[kMostLayers];
    vec4 ends = vec4(kFarthest);
    [[unroll]] for (uint k = 0u; k < kMostLayers; ++k) {
        layer[k] = k < kLayers ? texelFetch(layers, int(params.layer_first + local * kLayers + k)) : vec4(0.0, 0.0, 0.0, kFarthest);
        grid[k] = layer_grid(layer[k].xy, float(kWindow), float(kGrid));
        ends[k] = layer[k].w;
    }
    uint used = layer_count(ends);
    uint first = params.tuple_first + local * kLayers * kGrid * kGrid;

    uint end = params.stratum_first + params.stratum_count;
    uint i = 0u;
    do {
        uint y = divide(i, kWindow);
        WindowTexel texel = window_texel(tile, i - y * kWindow, y);
        uint stratum = params.stratum_first;
        do {
            WindowSample w = window_sample(texel, tile, stratum);
            uint own = w.hit ? layer_of(depth_at_middle(w.depth, w.motion.z, w.t), ends) : used;
            uint own_at = 0u;
            float depth = 0.0;
            bool own_counts = false;
            [[unroll]] for (uint k = 0u; k < kMostLayers; ++k) {
                vec2 p = grid_point(grid[k], w.place, w.t, float(kGrid));
                bool counts = inside && texel.there && k < used && k <= own && min(p.x, p.y) >= 0.0 && max(p.x, p.y) < float(kGrid);
                uint at = 4u * (first + k * kGrid * kGrid + (counts ? uint(p.y) * kGrid + uint(p.x) : 0u));
                if (counts) tuples[at + 3u] += 1.0;
                own_at = k == own ? at : own_at;
                depth = k == own ? depth_at_middle(w.depth, layer[k].z, w.t) - layer[k].w : depth;
                own_counts = k == own ? counts : own_counts;
            }
            if (own_counts) {
                tuples[own_at] += depth;
                tuples[own_at + 1u] += depth * depth;
                tuples[own_at + 2u] += 1.0;
            }
            ++stratum;
        } while (stratum < end);
        ++i;
    } while (i < kWindow * kWindow);
}
