// SPDX-License-Identifier: Apache-2.0
// The S-buffer of a light's view: all ranges of all texels, in a layout.
#pragma once

#include <optional>

#include "layouts/layout.hpp"
#include "layouts/memory.hpp"
#include "stages/grid.hpp"
#include "stages/layout_watch.hpp"
#include "stages/raster_stage.hpp"

namespace gnomon {

class SBuffer final : public ShadowMap {
public:
    /// Count the ranges of all lists. raster: compiled for the layout. watch: of a layout that is watched; it outlives the
    /// S-buffer.
    /// Errors: ErrorKind::out_of_memory, also later, when the count is known.
    SBuffer(gpu::Device& device, Programs& programs, std::unique_ptr<RasterStage> raster, const Layout& layout,
            LayoutWatch* watch = nullptr);

    uint64_t range_count() const { return counted().back().sizes[0]; }
    uint64_t list_count() const { return list_count_; }
    const shared::ViewGrid& grid() const { return raster_->grid(); }
    const Layout& layout() const { return layout_; }
    /// Of all lists and ranges, and of what they are made from.
    uint64_t map_bytes() const;
    /// How many ranges of the band that was filled last the layout has lost, if it counts them.
    const std::optional<gpu::Download>& lost() const { return lost_; }

    ItemOrder order() const override { return {raster_->grid().cell_count}; }
    uint32_t item_count() const override { return item_count_; }
    uint64_t longest() const override { return raster_->longest(); }
    std::map<std::string, uint64_t> counts() const override;
    /// As ShadowMap's; errors say how much a single block of items needs.
    std::vector<Band> bands(uint64_t bytes) const override;
    void fill(const Band& band) override;
    std::vector<gpu::Binding> read_bindings() const override;
    const SBuffer* s_buffer() const override { return this; }

private:
    /// A buffer of the layout, of the band in memory.
    struct Memory {
        LayoutBuffer description;
        std::string written;  ///< The name of the block that writes it.
        gpu::Buffer buffer;
    };
    /// A size of which each list's, or tile's, is known.
    struct Sizes {
        size_t index;
        std::string read;    ///< The name of what is read of it.
        gpu::Buffer values;  ///< Of the window.
        gpu::Buffer band;    ///< Of the band in memory: the values, or their sums.
    };
    /// The result of the count pass, which the host waits for when it first asks: what is before each block of items, and
    /// before the end.
    using Counted = std::vector<Totals>;
    const Counted& counted() const;
    Totals totals_of(uint32_t item_first, uint32_t item_count) const;
    Totals totals_of(const Band& run) const { return totals_of(run.item_first, run.item_count); }

    void count();
    void record_sizes(const gpu::Buffer& counts, uint64_t most_items);
    void record_triangles(const gpu::Buffer& sizes, const gpu::Buffer& totals);
    void hold(const Totals& held);
    void record_sums(const Totals& held);
    void record_pass(bool fill, const Band& part, const gpu::Binding& list_state);
    void record_lists(const std::string& stage, Layout::Pass pass, const std::vector<Band>& parts);
    void begin_counters(const Band& part);
    void begin_watch(const Totals& held);
    void end_watch(const Totals& held);
    void make_source(uint32_t item);
    size_t portion_of(uint32_t item) const;
    std::vector<Band> parts() const;  ///< Of the band, that one binding can hold, each of one portion.
    /// Of the layout, for what writes a part of the band; or that stand in for it where no band is in memory.
    std::vector<gpu::Binding> write_bindings(const Band* part) const;
    shared::RasterParams params(const Band& part) const;
    Totals bound_before(const Band& part) const;
    uint64_t held_bytes(const Totals& band) const;
    uint64_t work_bytes(const Totals& band) const;
    bool can_be_bound(const Totals& band) const;

    gpu::Device& device_;
    Programs& programs_;
    std::unique_ptr<RasterStage> raster_;
    Layout layout_;
    std::vector<Band> portions_;    ///< The raster stage's; all items, where it has none.
    size_t prepared_ = ~size_t(0);  ///< Which of them is.
    uint32_t item_count_ = 0;
    uint64_t list_count_ = 0;
    Band band_;                          ///< That is in memory.
    std::vector<gpu::Download> totals_;  ///< Of each size: what each block of items has.
    mutable std::optional<Counted> counted_;
    gpu::Buffer range_totals_;  ///< The ranges of each block of items.
    Unbound unbound_;           ///< Stands in for what is not in memory while ranges are counted.
    std::vector<Sizes> sizes_;
    std::vector<Memory> memory_;
    gpu::Buffer cursors_;   ///< Of the band's lists, while they are walked in several dispatches.
    gpu::Buffer counters_;  ///< The next place of each size that is allocated; then the layout's own counters.
    std::optional<gpu::Download> lost_;
    LayoutWatch* watch_;
};

}  // namespace gnomon
