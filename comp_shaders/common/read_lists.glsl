// SPDX-License-Identifier: Apache-2.0
// The lists of an S-buffer, for a test that walks them. Needs: common/shadow_test.glsl
#define LAYOUT_READ
#include "common/s_buffer.glsl"
layout(binding = 7, scalar) buffer Iterators { Iterator iterators[]; };  // Per hit, between dispatches that walk lists in parts.

// The hit's; any, where it has none here.
List list_of(ShadowTest test) {
    return list_at(test.here ? test.item - params.item_first : 0u, (test.texel.y & 7u) * kTileSize + (test.texel.x & 7u));
}

// At its start, or where the dispatch before left it.
Iterator walk_from(uint i, ShadowTest test, Query query) {
    bool first = !kResume || params.part == 0u;
    note_hit(i, test.here && first);
    note_query();
    Iterator it = layout_begin(list_of(test), query);
    if (!first && i < hit_count()) it = iterators[i];
    note_hit(i, test.here);
    return it;
}

void leave_walk(uint i, Iterator it) {
    if (kResume && i < hit_count()) iterators[i] = it;
}

// Found so by the dispatch before, or by other lists of the light: there is no more to walk.
bool known_shadowed(uint i, ShadowTest test) {
    return kResume && params.part > 0u && i < hit_count() && (lit[test.slot] & (1u << lit_bit(params.light))) == 0u;
}
