// SPDX-License-Identifier: Apache-2.0
// S-buffer layout "bits": the lists of a tile share its triangles: [depth 32 | entry 32]... Which of them a texel sees, and when, are bits: a row of as many as the tile has
// triangles for each texel in each of four bins of time, rows packed without gaps:
//     [bin 0: texel 0 | texel 1 | ... texel 63] [bin 1: ...] [bin 2: ...] [bin 3: ...]
// The shutter has sixteen steps, and a step's bin is its number, counted round: the quarters of its cell where there are four cells. A query reads the row of its texel and
// its bin, a word of 32 triangles at a time, and then only triangles whose bits are set. Ranges come back as long as the shutter: more triangles are tested, and the answer
// of a test that asks the triangles is the same.
// Memory: 40 bytes per triangle of a tile's list, 8 per tile; nothing per texel, and nothing per range.

const uint kRows = BINS * kTileTexels;

uint step_of(float t) { return uint(clamp(floor(t * float(STEPS)), 0.0, float(STEPS) - 1.0)); }
// Bit `i` of all rows is bit i & 31 of the tile's word i / 32.
uint row_at(uint texel, uint t_step, uint count) { return ((t_step % BINS) * kTileTexels + texel) * count; }

uint layout_open(List list) { return 0u; }
void layout_emit(List list, inout uint cursor, Range range) {
    uint first = first_triangles(tile_of(list)), count = end_triangles(tile_of(list)) - first;
    // By all lists of the tile, the same.
    set_listed(first + emitted_triangle, uvec2(floatBitsToUint(range.depth), range.entry));
    // Ranges are widened by rounding: not beyond a cell that consists of whole steps, whose times are its own to the bit.
    vec2 cell = emitted_cell * float(STEPS);
    bool whole = fract(cell.y - cell.x) == 0.0;
    uint lowest = whole ? uint(cell.x) : 0u, highest = whole ? uint(cell.y) - 1u : STEPS - 1u;
    uint from = clamp(step_of(range.enter), lowest, highest), until = clamp(step_of(range.leave), from, highest);
    [[unroll]] for (uint i = 0u; i < BINS; ++i) {
        uint at = row_at(list.texel, from + i, count) + emitted_triangle;
        if (from + i <= until) or_rows(first * WORDS + at / 32u, 1u << (at & 31u));
    }
}
void layout_close(List list, uint cursor) {}

// Bits of a word that belong to the row.
uint word_of(uint word, uint left) { return fetch_rows(word) & (left < 32u ? (1u << left) - 1u : kNone); }

// The next 32 triangles that a texel sees at any time.
uint any_of(uint texel, uint first, uint number, uint count) {
    uint left = count - number, bits = 0u;
    [[unroll]] for (uint i = 0u; i < BINS; ++i) {
        uint at = row_at(texel, i, count) + number, word = first * WORDS + at / 32u, skipped = at & 31u;
        bits |= fetch_rows(word) >> skipped;
        if (skipped + min(left, 32u) > 32u) bits |= fetch_rows(word + 1u) << (32u - skipped);
    }
    return left < 32u ? bits & ((1u << left) - 1u) : bits;
}

// For all ranges: the texel and 1, while there are more; the tile's first triangle, the next one, the number of them.
void turn_to_any(inout Iterator it) {
    uint bits = 0u;
    while (bits == 0u && it.z < it.w) {
        bits = any_of(it.x - 1u, it.y, it.z, it.w);
        it.z = bits != 0u ? it.z + uint(findLSB(bits)) : min(it.z + 32u, it.w);
    }
    it.x = bits != 0u ? it.x : 0u;
}

// The bits that are left of a word, the word, which triangle its first bit stands for (of the word where the row begins, perhaps less than 0), and the tile's last and 1.
Iterator layout_begin(List list, Query query) {
    uint first = first_triangles(tile_of(list)), end = end_triangles(tile_of(list)), count = end - first;
    uint at = row_at(list.texel, step_of(query.t), count);
    uint word = first * WORDS + at / 32u, begin = first - (at & 31u);
    Iterator it = Iterator(count > 0u ? word_of(count > 0u ? word : 0u, end - begin) & kNone << (at & 31u) : 0u, word, begin, count > 0u ? end : begin);
    if (it.x == 0u && it.w - it.z > 32u) {
        it.z += 32u;
        it.x = word_of(++it.y, it.w - it.z);
    }
    if (query.all) {
        it = Iterator(list.texel + 1u, first, 0u, count);
        turn_to_any(it);
    }
    return it;
}
bool layout_more(Iterator it) { return it.x != 0u || it.w - it.z > 32u; }
Range layout_next(inout Iterator it, Query query) {
    bool found = it.x != 0u;
    uint number = query.all ? it.y + it.z : it.z + uint(findLSB(it.x));
    uvec2 listed = fetch_listed(found ? number : 0u);
    if (query.all) {
        ++it.z;
        turn_to_any(it);
    } else {
        it.x &= it.x - 1u;
        if (it.x == 0u && it.w - it.z > 32u) {
            it.z += 32u;
            it.x = word_of(++it.y, it.w - it.z);
        }
    }
    // A word may have no bits.
    return Range(0.0, found ? 1.0 : -1.0, found ? uintBitsToFloat(listed.x) : kFarthest, listed.y, kFarthest);
}
