#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: the share of the light that reaches the hit: the value of its texel's visibility function at the hit's depth, less the bias; whatever the hit's time.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, offsets, clusters
// Writes:  Lit (visibility, a float per slot), ShadowCounts (clusters visited, clusters that shadow)
// Grid:    one invocation per hit
// Based on: Lokovic and Veach 2000, "Deep shadow maps", section 3; motion as in Andersson et al. 2015, "Filtered stochastic shadow mapping", section 2
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_test.glsl"
#include "common/bias.glsl"

READ_UINT(16, offsets)
READ_VEC2(17, clusters)

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    uint list = test.here ? test.list : 0u;
    uint k = fetch_offsets(list);
    uint end = fetch_offsets(list + 1u);
    float limit = biased_metres(test.depth);
    float visibility = 1.0;
    uint visited = 0u, tested = 0u;
    bool more = test.here && k < end;
    while (more) {
        vec2 cluster = fetch_clusters(k);
        bool nearer = cluster.x < limit;
        visibility = nearer ? cluster.y : visibility;
        if (kCount) ++visited;
        if (kCount) tested += nearer ? 1u : 0u;
        ++k;
        more = nearer && k < end;
    }
    write_visibility(test, visibility);
    if (kCount) add_shadow_counts(i, visited, tested, test.here);
}
