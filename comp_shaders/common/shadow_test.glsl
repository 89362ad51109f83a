// SPDX-License-Identifier: Apache-2.0
// What the shadow tests of all methods share: their bindings, the hit in the light's view, their counters.
#include "common/light_hit.glsl"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

layout(constant_id = 4) const bool kCount = false;   // Fill ShadowCounts.
layout(constant_id = 5) const bool kResume = false;  // Lists are walked in parts of kListChunk.
layout(constant_id = 6) const bool kFirst = false;   // Nothing was written to Lit before.
layout(constant_id = 7) const bool kAsked = false;   // Only pages that were asked for are there, and items are numbered among them.
layout(binding = 5, scalar) buffer Lit { uint lit[]; };
layout(binding = 6, scalar) buffer ShadowCounts { uint shadow_counts[]; };
READ_VEC4(14, asked)
READ_UVEC2(15, asked_nodes)
READ_UINT(40, leaves)  // Layouts have bindings 16 to 39.

// Hit `i` of the queue, as sample/ask left it. Its receiver has no barycentrics.
ShadowTest asked_hit(uint i) {
    ShadowTest test;
    bool inside = i < hit_count();
    vec4 asked = fetch_asked(inside ? i : 0u);
    uvec2 node_time = fetch_asked_nodes(inside ? i : 0u);
    inside = inside && node_time.x != kNone;
    uint leaf = fetch_leaves(inside ? node_time.x & ~kReversed : 0u);
    test.slot = fetch_queue(i < hit_count() ? i : 0u);
    test.own = fetch_hits(test.slot) & ~kReversed;
    test.at = asked.xy;
    test.limit = asked.z;
    test.depth = asked.w;
    test.behind = (node_time.x & kReversed) != 0u;
    test.receiver.t = uintBitsToFloat(node_time.y);
    // Of its list; of what stands still one cell has all segments.
    uint cells = max(params.light_cell_count, params.camera.segment_count);
    test.receiver.segment = divide(cell_of(test.receiver.t, cells) * params.camera.segment_count, cells);
    test.receiver.local_time = local_time_of(test.receiver.t, test.receiver.segment, params.camera.segment_count);
    // Its page, at the page's level.
    test.texel = texel_at(test.at, leaf & 15u);
    test.item = leaf >> 4u;
    test.here = inside && leaf != kNone && in_memory(test.item);
    test.list = list_of(test.item, test.texel);
    return test;
}

ShadowTest shadow_test(uint i) {
    if (kAsked) return asked_hit(i);
    return find_hit(i);
}

// Bits that are set: the lights that reach the hit, and all that have not been asked yet.
void write_lit(uint i, ShadowTest test, bool shadowed) {
    if (kFirst) {
        if (i < hit_count()) lit[test.slot] = shadowed ? ~(1u << lit_bit(params.light)) : 0xffffffffu;
    } else if (shadowed) {
        lit[test.slot] &= ~(1u << lit_bit(params.light));
    }
}

// Of methods whose visibility is a share: 0 to 1, as float bits, in a word of the slot for each light. Asked once, where the hit's list is.
void write_visibility(ShadowTest test, float visibility) {
    if (test.here) lit[test.slot] = floatBitsToUint(visibility);
}

void add_shadow_counts(uint i, uint visited, uint tested, bool was_cast) {
    uint all_visited = subgroupAdd(visited);
    uint all_tested = subgroupAdd(tested);
    uint all_cast = subgroupAdd(was_cast ? 1u : 0u);
    if (subgroupElect()) {
        uint block = (i / 65536u) * 3u;
        atomicAdd(shadow_counts[block], all_visited);
        atomicAdd(shadow_counts[block + 1u], all_tested);
        atomicAdd(shadow_counts[block + 2u], all_cast);
    }
}
