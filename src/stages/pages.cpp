// SPDX-License-Identifier: Apache-2.0
#include "stages/pages.hpp"

#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {

using gpu::Texel;

Pages::Pages(gpu::Device& device, Programs& programs, const Bins& bins)
    : device_(device),
      programs_(programs),
      bins_(bins),
      receivers_(device.allocate("receivers", uint64_t(bins.item_count()) * sizeof(glm::uvec2))),
      page_of_(device.allocate("page_of", scan_bytes(bins.item_count()))) {
    device.recorder().fill("sample/ask", receivers_, 0);
}

void Pages::list() {
    gpu::Recorder& recorder = device_.recorder();
    const uint32_t items = bins_.item_count();
    const shared::PageParams params{items};
    const gpu::Buffer marks = device_.allocate("page_marks", scan_bytes(items));
    recorder.fill("pages", marks, 0);
    recorder.dispatch("pages", programs_.get("pages/mark"),
                      bindings({{"receivers", &receivers_, Texel::rg32_uint},
                                {"bin_offsets", &bins_.offsets, Texel::r32_uint},
                                {"bin_entries", &bins_.entries, Texel::r32_uint},
                                {"Marks", &marks}}),
                      params, groups_of(items, 64));
    record_scan(device_, programs_, marks, items, page_of_);
    count_ = gpu::download_vector<uint32_t>(device_, page_of_, 1, uint64_t(items) * 4)[0];
    pages_ = device_.allocate("pages", std::max<uint64_t>(1, count_) * sizeof(glm::uvec4));
    recorder.dispatch(
        "pages", programs_.get("pages/list"),
        bindings({{"receivers", &receivers_, Texel::rg32_uint}, {"page_of", &page_of_, Texel::r32_uint}, {"Pages", &pages_}}),
        params, groups_of(items, 64));
}

}  // namespace gnomon
