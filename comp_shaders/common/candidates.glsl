// SPDX-License-Identifier: Apache-2.0
// A short queue of the list entries that an invocation has still to test, in registers: an array that is indexed by a variable would lie in memory.
const uint kMostCandidates = 4u;

struct Candidates {
    uvec4 entries;  // The last first.
    uint count;
};

Candidates no_candidates() { return Candidates(uvec4(0u), 0u); }
void push(inout Candidates c, uint entry, bool wanted) {
    c.entries = wanted ? uvec4(entry, c.entries.xyz) : c.entries;
    c.count += wanted ? 1u : 0u;
}
uint pop(inout Candidates c) {
    uint entry = c.entries.x;
    c.entries = c.entries.yzww;
    --c.count;
    return entry;
}
