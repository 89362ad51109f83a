// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "linked-buckets": five linked lists per texel and cell, whose heads lie side by side: [bucket 0 | 1 | 2 | 3 | longer]. A range within one of the shutter's
// sixteenths is in the bucket of that number, counted round; another is among the longer. A query walks the longer and its own bucket. Within kNear of a border a time
// counts to both sides, so that what was widened beyond its cell by rounding is not longer for that.
// Based on: Liu et al. 2009, "Efficient depth peeling via bucket sort"; Yang et al. 2010, "Real-time concurrent linked list construction on the GPU"
// Memory: 16 bytes per range (20 with the depth at its exit) and 4 for its link, 20 bytes per list.
#include "library/range_vec4.glsl"

const float kNear = 1e-5;
const uint kHeads = BUCKETS + 1u;

uint step_of(float t) { return uint(clamp(floor(t * float(STEPS)), 0.0, float(STEPS) - 1.0)); }

uint bucket_of(Range range) {
    uint first = step_of(range.enter + kNear);
    return step_of(range.leave - kNear) <= first ? first % BUCKETS : BUCKETS;
}

uint layout_open(List list) { return 0u; }
void layout_emit(List list, inout uint cursor, Range range) {
    uint node = allocate_ranges(1u);
    set_range(node, range);
    set_links(node, exchange_heads(list.index * kHeads + bucket_of(range), node));
}
void layout_close(List list, uint cursor) {}

// The next node, and the heads of the lists behind its own. For all ranges: the list, and how many of its heads are left.
void turn(inout Iterator it, Query query) {
    while (query.all && it.x == kNone && it.z > 0u) it.x = fetch_heads(it.y * kHeads + --it.z);
    for (uint i = 0u; i < 2u; ++i) {
        if (!query.all && it.x == kNone) it = Iterator(it.y, it.z, kNone);
    }
}
Iterator layout_begin(List list, Query query) {
    uint heads = list.index * kHeads, before = step_of(query.t - kNear) % BUCKETS, behind = step_of(query.t + kNear) % BUCKETS;
    Iterator it = Iterator(fetch_heads(heads + BUCKETS), fetch_heads(heads + before), before == behind ? kNone : fetch_heads(heads + behind));
    if (query.all) it = Iterator(kNone, list.index, kHeads);
    turn(it, query);
    return it;
}
bool layout_more(Iterator it) { return it.x != kNone; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    it.x = fetch_links(it.x);
    turn(it, query);
    return range;
}
