// SPDX-License-Identifier: Apache-2.0
// A short queue of the list entries that an invocation has still to test. Where the layout's ranges can be fetched by their place, one bit per range walked; else
// the entries themselves. Needs the layout.
#ifdef LAYOUT_INDEXED

const uint kMostCandidates = 32u;

struct Candidates {
    uint first;  // Place of the range that bit 0 stands for.
    uint bits;
};

Candidates candidates_begin(ListIterator it) { return Candidates(it.x, 0u); }
void candidates_add(inout Candidates c, inout uint count, uint entry, bool wanted) {
    c.bits |= wanted ? 1u << count : 0u;
    ++count;
}
bool candidates_more(Candidates c, uint next, uint count) { return c.bits != 0u; }
uint candidates_next(inout Candidates c, inout uint next) {
    uint bit = uint(findLSB(c.bits));
    c.bits &= c.bits - 1u;
    return floatBitsToUint(layout_at(c.first + bit).w);
}

#else

const uint kMostCandidates = 16u;

struct Candidates {
    uint entries[kMostCandidates];
};

Candidates candidates_begin(ListIterator it) {
    Candidates c;
    return c;
}
void candidates_add(inout Candidates c, inout uint count, uint entry, bool wanted) {
    c.entries[count] = entry;
    count += wanted ? 1u : 0u;
}
bool candidates_more(Candidates c, uint next, uint count) { return next < count; }
uint candidates_next(inout Candidates c, inout uint next) { return c.entries[next++]; }

#endif
