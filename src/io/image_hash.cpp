// SPDX-License-Identifier: Apache-2.0
#include "io/image_hash.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <vector>

namespace gnomon::io {

namespace {

/// Of words of 32 bits instead of bytes: four times as fast, and a change of one word changes the result still.
struct Fnv1a {
    uint64_t hash = 0xcbf29ce484222325u;

    void add(uint32_t word) { hash = (hash ^ word) * 0x100000001b3u; }
};

}  // namespace

uint64_t image_hash(uint32_t width, uint32_t height, std::span<const Channel> channels) {
    std::vector<const Channel*> sorted;
    for (const Channel& channel : channels) sorted.push_back(&channel);
    std::sort(sorted.begin(), sorted.end(), [](const Channel* a, const Channel* b) { return a->name < b->name; });
    Fnv1a sum;
    sum.add(width);
    sum.add(height);
    for (const Channel* channel : sorted) {
        sum.add(static_cast<uint32_t>(channel->name.size()));
        for (const char c : channel->name) sum.add(static_cast<uint8_t>(c));
        for (const float value : channel->values) sum.add(std::bit_cast<uint32_t>(value));
    }
    return sum.hash;
}

std::string hash_text(uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace gnomon::io
