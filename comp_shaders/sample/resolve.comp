#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: from sums over samples to the picture's channels, in place.
// Reads:   Film
// Writes:  Film: R, G, B, A, Z, and for each light visibility and its standard error (shared/film.h)
// Grid:    one invocation per pixel of the film
#extension GL_GOOGLE_include_directive : require
#include "common/stage.glsl"
#include "shared/film.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kFractional = false;  // The film holds squares of visibility.
layout(binding = 0, scalar) buffer Film { float film[]; };
layout(push_constant, scalar) uniform Push { ResolveParams params; };

void main() {
    uint i = group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= params.pixel_count) return;
    uint plane = params.pixel_count;
    float samples = float(params.spp);
    float hits = film[kFilmHits * plane + i];
    bool any_hit = hits > 0.0;
    [[unroll]] for (uint p = 0u; p < 3u; ++p) film[(kFilmRed + p) * plane + i] /= samples;
    film[kFilmHits * plane + i] = hits / samples;
    float depth = film[kFilmDepth * plane + i] / max(hits, 1.0);
    film[kFilmDepth * plane + i] = any_hit ? depth : 0.0;
    for (uint light = 0u; light < params.light_count; ++light) {
        uint mean = film_visibility(light) * plane + i;
        float visibility = any_hit ? film[mean] / hits : 0.0;
        float square = kFractional ? film[mean + plane] / max(hits, 1.0) : visibility;
        float spread = any_hit ? max(square - visibility * visibility, 0.0) : 0.0;
        film[mean] = visibility;
        film[mean + plane] = sqrt(spread / max(hits - 1.0, 1.0));
    }
}
