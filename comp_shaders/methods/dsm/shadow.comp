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

layout(binding = 16) uniform usamplerBuffer offsets;
layout(binding = 17) uniform samplerBuffer clusters;

void main() {
    uint i = take_hit();
    ShadowTest test = shadow_test(i);
    int list = test.here ? int(test.list) : 0;
    uint k = texelFetch(offsets, list).x;
    uint end = texelFetch(offsets, list + 1).x;
    float limit = biased_metres(test.depth);
    float visibility = 1.0;
    uint visited = 0u, tested = 0u;
    bool more = test.here && k < end;
    while (more) {
        vec2 cluster = texelFetch(clusters, int(k)).xy;
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
