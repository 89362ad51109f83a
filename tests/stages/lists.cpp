// SPDX-License-Identifier: Apache-2.0
// The lists that the device made, read back.
#include "lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "stages/read_lists.hpp"

namespace gnomon::test {
std::vector<std::vector<uint32_t>> read_bins(gpu::Device& device, const Bins& bins) {
    const size_t count = bins.item_count();
    const std::vector<uint32_t> offsets = gpu::download_vector<uint32_t>(device, bins.offsets, count + 1);
    const std::vector<uint32_t> entries = gpu::download_vector<uint32_t>(device, bins.entries, bins.entry_count);
    std::vector<std::vector<uint32_t>> lists;
    for (size_t i = 0; i < count; ++i) lists.emplace_back(entries.begin() + offsets[i], entries.begin() + offsets[i + 1]);
    return lists;
}

namespace {

std::vector<std::vector<shared::ListRange>> read(gpu::Device& device, Programs& programs, const SBuffer& s_buffer,
                                                 const Band& band, bool exits) {
    std::vector<std::vector<shared::ListRange>> lists;
    read_lists(device, programs, s_buffer, band, {.exits = exits}, [&](uint64_t first, auto counts, auto ranges) {
        EXPECT_EQ(first, uint64_t(band.item_first) * shared::kTileTexels + lists.size());
        for (const uint32_t count : counts) {
            lists.emplace_back(ranges.begin(), ranges.begin() + count);
            ranges = ranges.subspan(count);
        }
        EXPECT_TRUE(ranges.empty());
    });
    EXPECT_EQ(lists.size(), size_t(band.item_count) * shared::kTileTexels);
    return lists;
}

}  // namespace

std::vector<std::vector<RangeRecord>> read_ranges(gpu::Device& device, Programs& programs, const SBuffer& s_buffer,
                                                  const Band& band) {
    std::vector<std::vector<RangeRecord>> lists;
    for (const auto& ranges : read(device, programs, s_buffer, band, false)) {
        std::vector<RangeRecord>& list = lists.emplace_back();
        for (const shared::ListRange& r : ranges) list.push_back({r.enter, r.leave, r.depth, r.entry});
        std::sort(list.begin(), list.end());
    }
    return lists;
}

std::vector<std::vector<ExitRange>> read_exit_ranges(gpu::Device& device, Programs& programs, const SBuffer& s_buffer,
                                                     const Band& band) {
    std::vector<std::vector<ExitRange>> lists;
    for (const auto& ranges : read(device, programs, s_buffer, band, true)) {
        std::vector<ExitRange>& list = lists.emplace_back();
        for (const shared::ListRange& r : ranges) list.push_back({r.enter, r.leave, r.depth, r.entry, r.exit_depth});
    }
    return lists;
}

}  // namespace gnomon::test
