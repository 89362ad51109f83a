// SPDX-License-Identifier: Apache-2.0
// The S-buffer of a light's view: all ranges of all texels, in a layout.
#pragma once

#include <optional>

#include "layouts/layout.hpp"
#include "stages/grid.hpp"
#include "stages/raster_stage.hpp"

namespace gnomon {

class SBuffer final : public ShadowMap {
public:
    /// Count the ranges of all lists. raster: compiled for the layout.
    /// Errors: ErrorKind::out_of_memory, also later, when the count is known.
    SBuffer(gpu::Device& device, Programs& programs, std::unique_ptr<RasterStage> raster, const Layout& layout);

    uint64_t range_count() const { return counted().range_count; }
    uint64_t list_count() const { return list_count_; }
    const shared::ViewGrid& grid() const { return raster_->grid(); }
    const Layout& layout() const { return layout_; }
    /// Of all lists and ranges, and of what they are made from.
    uint64_t map_bytes() const;

    ItemOrder order() const override { return {raster_->grid().cell_count}; }
    uint32_t item_count() const override { return item_count_; }
    uint64_t longest() const override { return raster_->longest(); }
    std::map<std::string, uint64_t> counts() const override;
    /// As ShadowMap's; errors say how much a single block of items needs.
    std::vector<Band> bands(uint64_t bytes) const override;
    void fill(const Band& band) override;
    std::vector<gpu::Binding> read_bindings() const override;
    uint32_t range_base() const override { return range_base_; }
    const SBuffer* s_buffer() const override { return this; }

private:
    struct Memory {
        LayoutBuffer description;
        gpu::Buffer buffer;
        gpu::Buffer counts;  ///< What the count pass writes instead, where `buffer` is to be the prefix sum of it.
    };

    /// The result of the count pass, which the host waits for when it first asks.
    struct Counted {
        std::vector<uint64_t> block_ranges;  ///< Per kCountBlock items.
        uint64_t range_count = 0;
    };
    const Counted& counted() const;

    bool copies_sums(const LayoutBuffer& buffer) const;
    std::vector<Memory>::iterator copy_of(const Memory& sums);
    void count();
    void prepare(uint32_t item);
    size_t portion_of(uint32_t item) const;
    void record_pass(bool fill, const Band& part);
    std::vector<Band> parts(const Band& band) const;  ///< That one binding can hold, each of one portion.
    uint64_t bytes_per_range() const;

    gpu::Device& device_;
    Programs& programs_;
    std::unique_ptr<RasterStage> raster_;
    Layout layout_;
    std::vector<Band> portions_;    ///< The raster stage's; all items, where it has none.
    size_t prepared_ = ~size_t(0);  ///< Which of them is.
    uint32_t item_count_ = 0;
    uint64_t list_count_ = 0;
    uint32_t range_base_ = 0;
    gpu::Download totals_;
    mutable std::optional<Counted> counted_;
    gpu::Buffer raster_counts_;  ///< The ranges of each block of items.
    Unbound unbound_;            ///< Stands in for the ranges while they are counted.
    std::vector<Memory> memory_;
};

}  // namespace gnomon
