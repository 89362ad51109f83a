// SPDX-License-Identifier: Apache-2.0
// Asking for a page. Needs: receivers (per node: ordered bits of the farthest limit, 0: nobody asked; the triangle of those who asked, plus one, kNone: they lie on several)
#include "math/order.h"

// A hit on triangle `own`, from whose `limit` on nothing shadows it. Most find what they would write.
void ask_for(uint node, uint own, float limit) {
    // Of a surface that the light sees edge-on there may be none: nothing shadows it.
    uint order = ordered_bits(limit > -kFarthest ? limit : -kFarthest);
    if (receivers[node].x < order) atomicMax(receivers[node].x, order);
    uint before = receivers[node].y;
    if (before == 0u) before = atomicCompSwap(receivers[node].y, 0u, own + 1u);
    if (before != 0u && before != own + 1u && before != kNone) atomicMax(receivers[node].y, kNone);
}
