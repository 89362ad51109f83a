// SPDX-License-Identifier: Apache-2.0
// What a layout takes of memory.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "layouts/manifest.hpp"
#include "shared/params.h"

namespace gnomon {

/// Of a run of tiles: the sum of each size of a layout (LayoutSize), and its lists and tiles.
struct Totals {
    std::array<uint64_t, shared::kMostSizes> sizes{};
    uint64_t tiles = 0;

    uint64_t lists() const { return tiles * shared::kTileTexels; }
    Totals operator-(const Totals& before) const;
};

/// Of a size: one for each list, or tile.
uint64_t values_of_size(const LayoutSize& size, const Totals& of);

/// Each one's is known, not only the sum.
bool knows_each(const LayoutSize& size);

/// The elements of a buffer of the layout.
uint64_t elements_of(const Layout& layout, const LayoutBuffer& buffer, const Totals& of);

/// In bytes; at least one element.
uint64_t bytes_of(const Layout& layout, const LayoutBuffer& buffer, const Totals& of);

/// Bound as a whole by what writes a part of it: it may be written anywhere, or is so small that cutting it is not worth it.
bool is_whole(const LayoutBuffer& buffer);

/// What it takes, as a formula of lists, tiles, ranges and its own sizes: "16 ranges + 8 lists".
std::string bytes_formula(const Layout& layout);

}  // namespace gnomon
