// SPDX-License-Identifier: Apache-2.0
#include "stages/pages.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

constexpr const char* kStage = "pages";
constexpr uint64_t kPageBytes = 2 * sizeof(glm::uvec4);

}  // namespace

Pages::Pages(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins)
    : device_(device),
      programs_(programs),
      geometry_(geometry),
      bins_(bins),
      node_count_(bins.item_count()),
      longest_(bins.longest),
      receivers_(device.allocate("receivers", uint64_t(bins.item_count()) * sizeof(glm::uvec2))),
      leaves_(device.allocate("leaves", uint64_t(bins.item_count()) * 4)),
      entries_(device.allocate("page_entries", 4)) {
    device.recorder().fill("sample/ask", receivers_, 0);
}

shared::PageParams Pages::params(uint32_t page_first) const {
    return {bins_.grid, page_first, count_ - page_first, 0, node_count_, entry_first(), entry_first() + entry_count_};
}

void Pages::list() {
    gpu::Recorder& recorder = device_.recorder();
    const uint32_t items = bins_.item_count();
    const gpu::Buffer marks = device_.allocate("page_marks", scan_bytes(items));
    const gpu::Buffer page_of = device_.allocate("page_of", scan_bytes(items));
    recorder.fill(kStage, marks, 0);
    recorder.dispatch(kStage, programs_.get("pages/mark"),
                      bindings({{"receivers", &receivers_, Texel::rg32_uint},
                                {"bin_offsets", &bins_.offsets, Texel::r32_uint},
                                {"bin_entries", &bins_.entries, Texel::r32_uint},
                                {"Marks", &marks}}),
                      params(0), groups_of(items, 64));
    record_scan(device_, programs_, marks, items, page_of);
    count_ = gpu::download_vector<uint32_t>(device_, page_of, 1, uint64_t(items) * 4)[0];
    pages_ = device_.allocate("pages", std::max<uint64_t>(1, count_) * kPageBytes);
    recorder.dispatch(kStage, programs_.get("pages/list"),
                      bindings({{"receivers", &receivers_, Texel::rg32_uint},
                                {"page_of", &page_of, Texel::r32_uint},
                                {"bin_offsets", &bins_.offsets, Texel::r32_uint},
                                {"Pages", &pages_},
                                {"Leaves", &leaves_}}),
                      params(0), groups_of(items, 64));
}

gpu::Buffer Pages::longer(const gpu::Buffer& buffer, const char* name, uint64_t held, uint64_t bytes) {
    gpu::Buffer made = allocate(name, held + bytes);
    if (held > 0) device_.recorder().copy(kStage, buffer, 0, made, 0, held);
    return made;
}

gpu::Buffer Pages::allocate(const char* name, uint64_t bytes) {
    const gpu::Limits& limits = device_.limits();
    if (bytes > std::min(limits.max_storage_range, limits.most_elements(4) * 4)) {
        throw Error(ErrorKind::out_of_memory,
                    std::string(name) + " of " + std::to_string(bytes) + " bytes are more than the device can bind", "S-buffer",
                    "use --pages all");
    }
    return device_.allocate(name, std::max<uint64_t>(4, bytes));
}

// The units of the new pages, whose sums go to `units`.
uint32_t Pages::split(uint32_t page_first, const gpu::Buffer& longest, const gpu::Buffer& units) {
    gpu::Recorder& recorder = device_.recorder();
    const shared::PageParams params = this->params(page_first);
    const gpu::Buffer counts = allocate("page_units", scan_bytes(params.page_count));
    recorder.fill(kStage, counts, 0);
    recorder.dispatch(kStage, programs_.get("pages/split"),
                      bindings({{"bin_entries", &bins_.entries, Texel::r32_uint},
                                {"page_entries", &entries_, Texel::r32_uint},
                                {"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
                                {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                                {"Pages", &pages_},
                                {"Units", &counts},
                                {"Longest", &longest}}),
                      params, groups_of(params.page_count, 8));
    record_scan(device_, programs_, counts, params.page_count, units);
    return gpu::download_vector<uint32_t>(device_, units, 1, uint64_t(params.page_count) * 4)[0];
}

void Pages::sift(bool orthographic, const shared::PageParams& params, const Parts& parts, const gpu::Buffer& sieves,
                 const gpu::Buffer& counts) {
    device_.recorder().dispatch(kStage, programs_.get("pages/sift", {orthographic}),
                                bindings({{"bin_entries", &bins_.entries, Texel::r32_uint},
                                          {"page_entries", &entries_, Texel::r32_uint},
                                          {"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
                                          {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                                          {"pages", &pages_, Texel::rgba32_uint},
                                          {"units", &parts.units, Texel::r32_uint},
                                          {"receivers", &parts.receivers, Texel::rg32_uint},
                                          {"Sieves", &sieves},
                                          {"Counts", &counts}}),
                                params, groups_of(params.unit_count, 8));
}

void Pages::hand_down(const shared::PageParams& params, const Parts& parts, const gpu::Buffer& sieves,
                      const gpu::Buffer& places, const gpu::Buffer& entries) {
    device_.recorder().dispatch(kStage, programs_.get("pages/hand_down"),
                                bindings({{"bin_entries", &bins_.entries, Texel::r32_uint},
                                          {"page_entries", &entries_, Texel::r32_uint},
                                          {"pages", &pages_, Texel::rgba32_uint},
                                          {"units", &parts.units, Texel::r32_uint},
                                          {"sieves", &sieves, Texel::r32_uint},
                                          {"places", &places, Texel::r32_uint},
                                          {"Entries", &entries}}),
                                params, groups_of(params.unit_count, 8));
}

void Pages::adopt(bool write, const shared::PageParams& params, const Parts& parts, const gpu::Buffer& places,
                  const gpu::Buffer& ranks, const gpu::Buffer& target) {
    const Unbound unbound(device_, 3);
    device_.recorder().dispatch(
        kStage, programs_.get("pages/adopt", {write}),
        bindings({{"pages", &pages_, Texel::rgba32_uint},
                  {"units", &parts.units, Texel::r32_uint},
                  {"receivers", &parts.receivers, Texel::rg32_uint},
                  {"places", &places, Texel::r32_uint},
                  write ? gpu::Binding{"page_of", &ranks, Texel::r32_uint} : unbound.at(0, "page_of", Texel::r32_uint),
                  write ? unbound.at(1, "Marks") : gpu::Binding{"Marks", &target},
                  write ? gpu::Binding{"NewPages", &target} : unbound.at(1, "NewPages"),
                  write ? gpu::Binding{"Leaves", &leaves_} : unbound.at(2, "Leaves")}),
        params, groups_of(uint64_t(params.unit_count) * 4, 64));
}

void Pages::refine(bool orthographic, const std::function<void(const Parts&)>& ask) {
    gpu::Recorder& recorder = device_.recorder();
    const gpu::Buffer longest = device_.allocate("longest_page", 4);
    recorder.fill(kStage, longest, 0);
    for (uint32_t page_first = 0; page_first < count_;) {
        shared::PageParams params = this->params(page_first);
        const gpu::Buffer units = allocate("unit_sums", scan_bytes(params.page_count));
        params.unit_count = split(page_first, longest, units);
        if (params.unit_count == 0) break;

        // Whoever lies in a page that was split asks for the part that he lies in.
        const uint64_t nodes = uint64_t(params.unit_count) * 4;
        const gpu::Buffer receivers = allocate("part_receivers", nodes * sizeof(glm::uvec2));
        recorder.fill(kStage, receivers, 0);
        const Parts parts{page_first, params.node_first, units, receivers};
        ask(parts);

        const uint64_t counters = uint64_t(params.unit_count) * shared::kUnitCounts;
        const gpu::Buffer places = allocate("part_places", scan_bytes(counters));
        const gpu::Buffer ranks = allocate("part_ranks", scan_bytes(nodes));
        const gpu::Buffer sieves = allocate("sieves", uint64_t(params.unit_count) * shared::kPageUnit / 2);
        {
            const gpu::Buffer counts = allocate("part_counts", scan_bytes(counters));
            recorder.fill(kStage, counts, 0);
            sift(orthographic, params, parts, sieves, counts);
            record_scan(device_, programs_, counts, static_cast<uint32_t>(counters), places);
            const gpu::Buffer marks = allocate("part_marks", scan_bytes(nodes));
            recorder.fill(kStage, marks, 0);
            adopt(false, params, parts, places, ranks, marks);
            record_scan(device_, programs_, marks, static_cast<uint32_t>(nodes), ranks);
        }
        const gpu::Download entry_total = recorder.download(places, counters * 4, 4);
        const gpu::Download page_total = recorder.download(ranks, nodes * 4, 4);
        const uint32_t new_entries = gpu::values_of<uint32_t>(device_, entry_total)[0];
        const uint32_t new_pages = gpu::values_of<uint32_t>(device_, page_total)[0];
        if (uint64_t(params.entry_next) + new_entries >= shared::kReversed)
            throw Error(ErrorKind::out_of_memory, "the lists of pages are more than 32 bits can number", "S-buffer",
                        "use --pages all");

        gpu::Buffer made_entries = longer(entries_, "page_entries", uint64_t(entry_count_) * 4, uint64_t(new_entries) * 4);
        hand_down(params, parts, sieves, places, made_entries);
        leaves_ = longer(leaves_, "leaves", uint64_t(node_count_) * 4, nodes * 4);
        const gpu::Buffer made_pages = allocate("new_pages", std::max<uint64_t>(1, new_pages) * kPageBytes);
        adopt(true, params, parts, places, ranks, made_pages);
        pages_ = longer(pages_, "pages", count_ * kPageBytes, new_pages * kPageBytes);
        if (new_pages > 0) recorder.copy(kStage, made_pages, 0, pages_, count_ * kPageBytes, new_pages * kPageBytes);
        entries_ = std::move(made_entries);

        page_first = count_;
        count_ += new_pages;
        entry_count_ += new_entries;
        node_count_ += static_cast<uint32_t>(nodes);
    }
    longest_ = gpu::download_vector<uint32_t>(device_, longest, 1)[0];
}

}  // namespace gnomon
