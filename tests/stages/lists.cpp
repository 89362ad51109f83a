// SPDX-License-Identifier: Apache-2.0
// The lists that the device made, read back.
#include "lists.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>

#include "oracle/prefix_sum.hpp"
#include "read_ranges.h"
#include "reader_table.h"
#include "stages/grid.hpp"

namespace gnomon::test {
namespace {

gpu::Shader reader_of(const std::string& layout) {
    for (const ReaderEntry& entry : kReaderTable) {
        if (layout == entry.layout) return {"read_ranges@" + layout, {entry.words, entry.word_count}};
    }
    throw Error(ErrorKind::internal, "no reader of layout " + layout, "tests/stages/CMakeLists.txt",
                "configure the build again");
}

}  // namespace

std::vector<std::vector<uint32_t>> read_bins(gpu::Device& device, const Bins& bins) {
    const size_t count = bins.item_count();
    const std::vector<uint32_t> offsets = gpu::download_vector<uint32_t>(device, bins.offsets, count + 1);
    const std::vector<uint32_t> entries = gpu::download_vector<uint32_t>(device, bins.entries, bins.entry_count);
    std::vector<std::vector<uint32_t>> lists;
    for (size_t i = 0; i < count; ++i) lists.emplace_back(entries.begin() + offsets[i], entries.begin() + offsets[i + 1]);
    return lists;
}

std::vector<std::vector<RangeRecord>> read_ranges(gpu::Device& device, const SBuffer& s_buffer, const std::string& layout,
                                                  const Band& band) {
    const uint32_t list_count = band.item_count * shared::kTileTexels;
    gpu::Buffer counts = device.allocate("counts", list_count * sizeof(uint32_t));
    gpu::Buffer found = device.allocate("found", 16);
    const auto run = [&](bool copy) {
        std::vector<gpu::Binding> all = {{"Counts", &counts}, {"Found", &found}};
        for (const gpu::Binding& b : s_buffer.read_bindings()) all.push_back(b);
        const gpu::Constant constant{0, copy};
        gpu::Recorder recorder(device);
        recorder.dispatch("read_ranges", device.program(reader_of(layout), {&constant, 1}), all,
                          shared::ReadRangesParams{band.item_first * shared::kTileTexels, list_count, s_buffer.range_base()},
                          groups_of(list_count, 64));
        recorder.submit();
    };
    run(false);
    const std::vector<uint64_t> sums = oracle::exclusive_sums(gpu::download_vector<uint32_t>(device, counts, list_count));
    counts = gpu::upload_new(device, "counts", std::vector<uint32_t>(sums.begin(), sums.end()));
    found = device.allocate("found", sums.back() * sizeof(RangeRecord));
    run(true);
    const std::vector<RangeRecord> ranges = gpu::download_vector<RangeRecord>(device, found, sums.back());
    std::vector<std::vector<RangeRecord>> lists;
    for (size_t i = 0; i < list_count; ++i) {
        lists.emplace_back(ranges.begin() + static_cast<ptrdiff_t>(sums[i]),
                           ranges.begin() + static_cast<ptrdiff_t>(sums[i + 1]));
        std::sort(lists.back().begin(), lists.back().end());
    }
    return lists;
}

std::vector<std::vector<ExitRange>> read_exit_ranges(gpu::Device& device, const SBuffer& s_buffer) {
    std::map<std::string_view, const gpu::Buffer*> buffers;
    for (const gpu::Binding& binding : s_buffer.read_bindings()) buffers[binding.name] = binding.buffer;
    const auto offsets = gpu::download_vector<uint32_t>(device, *buffers.at("list_offsets"), s_buffer.list_count() + 1);
    const auto ranges = gpu::download_vector<glm::vec4>(device, *buffers.at("ranges"), s_buffer.range_count());
    const auto exits = gpu::download_vector<float>(device, *buffers.at("range_exits"), s_buffer.range_count());
    std::vector<std::vector<ExitRange>> lists(s_buffer.list_count());
    for (size_t i = 0; i < lists.size(); ++i) {
        for (uint32_t r = offsets[i]; r < offsets[i + 1]; ++r)
            lists[i].push_back({ranges[r].x, ranges[r].y, ranges[r].z, std::bit_cast<uint32_t>(ranges[r].w), exits[r]});
    }
    return lists;
}

}  // namespace gnomon::test
