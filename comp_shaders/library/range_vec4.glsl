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
