#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: each hit asks for its page of the light's view: 8 x 8 texels in one cell of time. It is kept as the light's view holds it, for the test.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, positions
// Writes:  Asked (place in raster space, limit of depth, depth), AskedNodes (the item of the window, with kReversed where the hit is lit from behind, or kNone; time), Lit (of
//          hits that are inside a closed shell: bit `light`), Receivers (per item, common/ask.glsl)
// Grid:    one invocation per hit
#extension GL_GOOGLE_include_directive : require
#define GN_SHELLS
#include "common/light_hit.glsl"

layout(binding = 5, scalar) writeonly buffer Asked { vec4 asked[]; };
layout(binding = 6, scalar) writeonly buffer AskedNodes { uvec2 asked_nodes[]; };
layout(binding = 10, scalar) buffer Lit { uint lit[]; };
layout(binding = 7, scalar) coherent buffer Receivers { uvec2 receivers[]; };
#include "common/ask.glsl"

void main() {
    uint i = take_hit();
    ShadowTest test = find_hit(i);
    bool dark = is_inside(test);
    bool asks = test.here && !dark;
    if (dark) lit[test.slot] &= ~(1u << lit_bit(params.light));
    if (i < hit_count()) {
        asked[i] = vec4(test.at, test.limit, test.depth);
        asked_nodes[i] = uvec2(asks ? test.item | (test.behind ? kReversed : 0u) : kNone, floatBitsToUint(test.receiver.t));
    }
    if (asks) ask_for(test.item, test.own, deepest(test));
}
