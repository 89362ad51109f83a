// SPDX-License-Identifier: Apache-2.0
// The lists that the device made, read back.
#pragma once

#include "stages/layout_stages.hpp"
#include "stages/s_buffer.hpp"

namespace gnomon::test {

/// Entries per tile and cell: tile * cell_count + cell.
std::vector<std::vector<uint32_t>> read_bins(gpu::Device& device, const Bins& bins);

struct RangeRecord {
    float enter = 0.0f;
    float leave = 0.0f;
    float nearest = 0.0f;
    uint32_t entry = 0;

    auto operator<=>(const RangeRecord&) const = default;  // NOLINT(modernize-use-nullptr): the check takes it for a 0
};

/// The ranges of a band that is filled, per list (item * kTileTexels + row * 8 + column), items counted from the band's first;
/// each list sorted.
std::vector<std::vector<RangeRecord>> read_ranges(gpu::Device& device, Programs& programs, const SBuffer& s_buffer,
                                                  const Band& band);

struct ExitRange {
    float enter, leave, enter_depth;
    uint32_t entry;
    float exit_depth = 0.0f;
};

/// The same of ranges with exit depths; each list in the layout's order.
std::vector<std::vector<ExitRange>> read_exit_ranges(gpu::Device& device, Programs& programs, const SBuffer& s_buffer,
                                                     const Band& band);

}  // namespace gnomon::test
