// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "array-halves": all ranges of a list side by side, in three parts: [first half | both | second half]. The shutter has eight steps, and a step of even number
// is a first half, as of the quarters that four cells are. A query in a first half reads the first two parts, in a second half the last two: one run of memory. Within kNear
// of a border a time counts to both sides. Lists of more than 60,000 ranges have all in both.
// Memory: 16 bytes per range (20 with the depth at its exit), 12 bytes per list (its count, its offset, and where its parts begin).
#include "library/range_vec4.glsl"

const float kNear = 1e-5;
const uint kMostParted = 60000u;

// 0: only in a first half, 2: only in a second one, 1: in more than one step.
uint step_of(float t) { return uint(clamp(floor(t * float(STEPS)), 0.0, float(STEPS) - 1.0)); }
uint part_of(float enter, float leave) {
    uint first = step_of(enter + kNear);
    return step_of(leave - kNear) > first ? 1u : 2u * (first & 1u);
}

uint layout_open(List list) { return first_ranges(list); }
void layout_emit(List list, inout uint cursor, Range range) {
    set_range(cursor, range);
    ++cursor;
}
void layout_close(List list, uint cursor) {}

// Dijkstra's flag: [first, both) and [second, end) are done, [at, second) are not.
void layout_finish(List list) {
    uint first = first_ranges(list), end = end_ranges(list), both = first, second = end, at = first;
    if (end - first > kMostParted) at = end;
    while (at < second) {
        vec4 range = fetch_ranges(at);
        uint part = part_of(range.x, range.y);
        if (part == 0u) {
            if (at > both) swap_ranges(at, both);
            ++both;
        } else if (part == 2u) {
            --second;
            swap_ranges(at, second);
        }
        at += part == 2u ? 0u : 1u;
    }
    bool parted = end - first <= kMostParted;
    set_parts(list.index, parted ? (both - first) | (end - second) << 16u : 0u);
}

// The next range, and the end of what is read.
Iterator layout_begin(List list, Query query) {
    uint parts = fetch_parts(list.index), before = step_of(query.t - kNear), behind = step_of(query.t + kNear);
    bool all = query.all || before != behind;
    bool begins = !all && (before & 1u) == 1u, ends = !all && (before & 1u) == 0u;
    return Iterator(first_ranges(list) + (begins ? parts & 65535u : 0u), end_ranges(list) - (ends ? parts >> 16u : 0u));
}
bool layout_more(Iterator it) { return it.x < it.y; }
Range layout_next(inout Iterator it, Query query) {
    Range range = fetch_range(it.x);
    ++it.x;
    return range;
}
