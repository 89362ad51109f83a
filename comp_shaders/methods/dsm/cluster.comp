#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: a texel's visibility function from its samples: those that lie within an extent of the nearest make a cluster, and so on with what is deeper. A cluster's depth
//          is its samples' mean; its opacity is their share of the samples that no nearer cluster has stopped. Count, or fill after the scan.
// Reads:   map_samples (metres; per tile, sample and texel), offsets (fill)
// Writes:  Counts (clusters per texel) or Clusters (metres, visibility behind it), Offsets (where each texel's clusters begin)
// Grid:    one invocation per texel of the batch's tiles
// Based on: Lokovic and Veach 2000, "Deep shadow maps", section 3; motion as in Andersson et al. 2015, "Filtered stochastic shadow mapping", section 2
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFill = false;
READ_FLOAT(0, map_samples)
READ_UINT(1, scanned)
layout(binding = 2, scalar) writeonly buffer Counts { uint counts[]; };
layout(binding = 3, scalar) writeonly buffer Clusters { vec2 clusters[]; };
layout(binding = 4, scalar) writeonly buffer Offsets { uint offsets[]; };
layout(push_constant, scalar) uniform Push { ClusterParams params; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    bool inside = i < params.tile_count * kTileTexels;
    i = inside ? i : 0u;
    uint base = (i / kTileTexels) * params.spp * kTileTexels + (i & (kTileTexels - 1u));
    uint place = kFill ? fetch_scanned(i) : 0u;
    if (kFill && inside) offsets[params.texel_first + i] = params.cluster_first + place;

    uint count = 0u;
    float left = float(params.spp);  // Samples that nothing has stopped yet.
    float before = -kFarthest;       // All samples up to this depth are in clusters.
    bool more = inside;
    while (more) {
        float nearest = kFarthest;
        uint s = 0u;
        do {
            float z = fetch_map_samples(base + s * kTileTexels);
            nearest = z > before ? min(nearest, z) : nearest;
            ++s;
        } while (s < params.spp);
        more = nearest < kFarthest;
        if (more) {
            float end = nearest + params.extent + params.extent_per_metre * nearest, sum = 0.0, held = 0.0;
            s = 0u;
            do {
                float z = fetch_map_samples(base + s * kTileTexels);
                bool here = z >= nearest && z <= end;
                sum += here ? z - nearest : 0.0;
                held += here ? 1.0 : 0.0;
                ++s;
            } while (s < params.spp);
            left -= held;
            if (kFill) clusters[place + count] = vec2(nearest + sum / held, left / float(params.spp));
            ++count;
            before = end;
        }
    }
    if (!kFill && inside) counts[i] = count;
}
