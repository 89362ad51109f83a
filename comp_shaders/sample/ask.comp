#version 460
// SPDX-License-Identifier: Apache-2.0
// Purpose: each hit asks for its page of the light's view: 8 x 8 texels in one cell of time. It is kept as the light's view holds it, for the test.
// Reads:   queue, hits, triangles, raster_vertices (camera), light_vertices, positions
// Writes:  Asked (place in raster space, limit of depth, time), AskedItems (of the window, or kNone), Receivers (per item: ordered bits of the farthest limit, 0: nobody asked;
//          the triangle of those who asked, plus one, kNone: they lie on several)
// Grid:    one invocation per hit
#extension GL_GOOGLE_include_directive : require
#include "common/light_hit.glsl"
#include "math/order.h"

layout(binding = 5, scalar) writeonly buffer Asked { vec4 asked[]; };
layout(binding = 6, scalar) writeonly buffer AskedItems { uint asked_items[]; };
layout(binding = 7, scalar) coherent buffer Receivers { uvec2 receivers[]; };

void main() {
    uint i = take_hit();
    ShadowTest test = find_hit(i);
    // Of a surface that the light sees edge-on there is no limit: nothing shadows it.
    float limit = test.limit > -kFarthest ? test.limit : -kFarthest;
    if (i < hit_count()) {
        asked[i] = vec4(test.at, limit, test.receiver.t);
        asked_items[i] = test.here ? test.item : kNone;
    }
    if (test.here) {
        // Most find what they would write.
        uint order = ordered_bits(limit);
        if (receivers[test.item].x < order) atomicMax(receivers[test.item].x, order);
        uint before = receivers[test.item].y;
        if (before == 0u) before = atomicCompSwap(receivers[test.item].y, 0u, test.own + 1u);
        if (before != 0u && before != test.own + 1u && before != kNone) atomicMax(receivers[test.item].y, kNone);
    }
}
