#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: does the light reach the hit? Not where the map's sample of the hit's texel and stratum of time is nearer than the hit by more than the bias. With kMotion the
//          sample's surface is first moved to the hit's time.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, map_samples
// Writes:  Lit (per slot: bit `light`), ShadowCounts (samples visited, samples tested)
// Grid:    one invocation per hit
// Based on: Akenine-Moller et al. 2007, "Stochastic rasterization using time-continuous triangles", section 5; motion: Andersson et al. 2015, section 5.1, eq. 12
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_test.glsl"
#include "common/bias.glsl"

layout(constant_id = 10) const bool kMotion = false;
READ_FLOAT(16, map_samples)  // Depth in metres, and motion in metres per shutter.

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    uint place = (kMotion ? 2u : 1u) * (test.here ? test.list - params.range_first : 0u);
    float depth = fetch_map_samples(place);
    if (kMotion) {
        uint stratum = cell_of(test.receiver.t, params.light_cell_count);
        vec3 point = sample_point(pixel_hash(test.texel.x, test.texel.y, light_seed(params.seed, params.light)), test.texel.x, test.texel.y, stratum, params.light_cell_length);
        depth += fetch_map_samples(place + 1u) * (test.receiver.t - point.z);
    }
    bool shadowed = test.here && depth < biased_metres(test.depth);
    write_lit(i, test, shadowed);
    if (kCount) add_shadow_counts(i, 1u, test.here ? 1u : 0u, test.here);
}
