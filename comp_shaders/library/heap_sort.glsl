// SPDX-License-Identifier: Apache-2.0
// Sorts a list in memory, the least key first. Needs: library/range_vec4.glsl, float sort_key(uint place)
// An invocation may go round loops 65,535 times in all on some drivers: longer lists stay as they are.
const uint kMostSorted = 1500u;

// The place at `root` of the heap [first, first + count) sinks to where both below it are no larger.
void sink(uint first, uint root, uint count) {
    uint at = root;
    bool more = 2u * at + 1u < count;
    while (more) {
        uint below = 2u * at + 1u;
        below += below + 1u < count && sort_key(first + below + 1u) > sort_key(first + below) ? 1u : 0u;
        more = sort_key(first + below) > sort_key(first + at);
        if (more) swap_ranges(first + at, first + below);
        at = below;
        more = more && 2u * at + 1u < count;
    }
}

void heap_sort(uint first, uint end) {
    uint count = end - first;
    if (count < 2u || count > kMostSorted) return;
    for (uint root = count / 2u; root > 0u; --root) sink(first, root - 1u, count);
    for (uint left = count - 1u; left > 0u; --left) {
        swap_ranges(first, first + left);
        sink(first, 0u, left);
    }
}
