// SPDX-License-Identifier: Apache-2.0
#include "stages/read_lists.hpp"

#include <algorithm>
#include <gnomon/error.hpp>
#include <numeric>

namespace gnomon {
namespace {

// Of one run: of what all take together, little.
constexpr uint32_t kMostLists = 131072;
constexpr uint64_t kMostRanges = 262144;
// What a wrong layout may give for each range that it was given, before it is not worth to be read.
constexpr uint64_t kMostCopies = 4;

// Of a band, so far.
void check_total(const SBuffer& s_buffer, const Band& band, uint64_t list_first, std::span<const uint32_t> counts,
                 uint64_t total) {
    if (total <= kMostCopies * band.range_count + kMostRanges) return;
    const auto longest = std::max_element(counts.begin(), counts.end());
    const uint64_t list = list_first + static_cast<uint64_t>(longest - counts.begin());
    throw Error(ErrorKind::internal,
                "list " + std::to_string(list) + " gives " + std::to_string(*longest) + " ranges of " +
                    std::to_string(band.range_count) + " ranges in all lists",
                s_buffer.layout().name, "correct the layout, if it is yours, or report it");
}

class Reader {
public:
    Reader(gpu::Device& device, Programs& programs, const SBuffer& s_buffer, bool exits)
        : device_(device),
          programs_(programs),
          s_buffer_(s_buffer),
          stage_(s_buffer.layout().stage(read_lists_stage(exits))),
          parts_(groups_of(std::max<uint64_t>(1, s_buffer.longest()), shared::kListChunk)) {}

    std::vector<uint32_t> counts(uint64_t list_first, uint32_t list_count) {
        const gpu::Buffer counts = gpu::upload_new(device_, "places", std::vector<uint32_t>(list_count));
        walk(list_first, list_count, counts, device_.allocate("found", sizeof(shared::ListRange)), false);
        return gpu::download_vector<uint32_t>(device_, counts, list_count);
    }

    std::vector<shared::ListRange> ranges(uint64_t list_first, std::span<const uint32_t> counts, uint64_t range_count) {
        if (range_count == 0) return {};
        std::vector<uint32_t> places(counts.size());
        std::exclusive_scan(counts.begin(), counts.end(), places.begin(), 0u);
        const gpu::Buffer found = device_.allocate("found", range_count * sizeof(shared::ListRange));
        walk(list_first, static_cast<uint32_t>(counts.size()), gpu::upload_new(device_, "places", places), found, true);
        return gpu::download_vector<shared::ListRange>(device_, found, range_count);
    }

private:
    void walk(uint64_t list_first, uint32_t list_count, const gpu::Buffer& places, const gpu::Buffer& found, bool copy) {
        const gpu::Buffer iterators = device_.allocate("iterators", (parts_ > 1 ? list_count : 1) * sizeof(glm::uvec4));
        std::vector<gpu::Binding> all = {{"Places", &places}, {"Found", &found}, {"Iterators", &iterators}};
        for (const gpu::Binding& binding : s_buffer_.read_bindings()) all.push_back(binding);
        const gpu::Program& program = programs_.get(stage_, {copy, parts_ > 1});
        for (uint32_t part = 0; part < parts_; ++part)
            device_.recorder().dispatch("sbuffer/read", program, all,
                                        shared::ReadListsParams{static_cast<uint32_t>(list_first), list_count, part},
                                        groups_of(list_count, 64));
    }

    gpu::Device& device_;
    Programs& programs_;
    const SBuffer& s_buffer_;
    std::string stage_;
    uint64_t parts_;
};

}  // namespace

std::string read_lists_stage(bool exits) { return exits ? "sbuffer/read_exits" : "sbuffer/read"; }

void read_lists(gpu::Device& device, Programs& programs, const SBuffer& s_buffer, const Band& band, const ReadLists& what,
                const OnLists& on_lists) {
    Reader reader(device, programs, s_buffer, what.exits);
    const uint64_t base = uint64_t(band.item_first) * shared::kTileTexels,
                   end = uint64_t(band.item_count) * shared::kTileTexels;
    uint64_t total = 0;
    for (uint64_t first = 0; first < end; first += kMostLists) {
        const auto count = static_cast<uint32_t>(std::min<uint64_t>(kMostLists, end - first));
        const std::vector<uint32_t> counts = reader.counts(first, count);
        total = std::accumulate(counts.begin(), counts.end(), total);
        check_total(s_buffer, band, base + first, counts, total);
        if (what.only_counts) {
            on_lists(base + first, counts, {});
            continue;
        }
        for (uint32_t from = 0, to = 0; from < count; from = to) {
            uint64_t ranges = counts[to++];
            while (to < count && ranges + counts[to] <= kMostRanges) ranges += counts[to++];
            const std::span<const uint32_t> run = std::span(counts).subspan(from, to - from);
            on_lists(base + first + from, run, reader.ranges(first + from, run, ranges));
        }
    }
}

}  // namespace gnomon
