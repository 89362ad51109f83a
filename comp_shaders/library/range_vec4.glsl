// SPDX-License-Identifier: Apache-2.0
// A range in the buffers "ranges", vec4 [enter leave depth entry], and "exits", a float where ranges have a depth at their exit.
void set_range(uint place, Range range) {
    set_ranges(place, vec4(range.enter, range.leave, range.depth, uintBitsToFloat(range.entry)));
    set_exits(place, range.exit_depth);
}

Range fetch_range(uint place) {
    vec4 range = fetch_ranges(place);
    return Range(range.x, range.y, range.z, floatBitsToUint(range.w), fetch_exits(place));
}

void swap_ranges(uint a, uint b) {
    Range range_a = fetch_range(a), range_b = fetch_range(b);
    set_range(a, range_b);
    set_range(b, range_a);
}
