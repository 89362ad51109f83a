// SPDX-License-Identifier: Apache-2.0
// The S-buffer of a light's view: all ranges of all texels, in a layout.
#pragma once

#include "layouts/layout.hpp"
#include "stages/bin.hpp"
#include "stages/shadow_map.hpp"

namespace gnomon {

class SBuffer final : public ShadowMap {
public:
    /// Count the ranges of all lists. raster: the stage that finds them ("raster/conservative").
    /// Errors: ErrorKind::out_of_memory where one block of tiles alone is too much for the device.
    SBuffer(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins, const Layout& layout,
            const std::string& raster, bool orthographic);

    uint64_t range_count() const { return range_count_; }
    uint64_t list_count() const { return list_count_; }

    ItemOrder order() const override { return {bins_.grid.cell_count, bins_.grid.cell_count, 1}; }
    uint32_t item_count() const override { return item_count_; }
    uint64_t longest() const override { return longest_; }
    std::map<std::string, uint64_t> counts() const override { return {{"ranges", range_count_}}; }
    /// As ShadowMap's; errors say how much a single block of items needs.
    std::vector<Band> bands(uint64_t bytes) const override;
    void fill(const Band& band) override;
    std::vector<gpu::Binding> read_bindings() const override;
    uint32_t range_base() const override { return range_base_; }

private:
    struct Memory {
        LayoutBuffer description;
        gpu::Buffer buffer;
    };

    void count();
    void record_pass(gpu::Recorder& recorder, bool fill, const Band& part);
    std::vector<Band> parts(const Band& band) const;  ///< That one binding can hold.
    uint64_t bytes_per_range() const;

    gpu::Device& device_;
    Programs& programs_;
    const Geometry& geometry_;
    const Bins& bins_;
    Layout layout_;
    std::string raster_;
    uint32_t items_per_group_;
    uint64_t longest_;
    bool orthographic_;
    uint32_t item_count_ = 0;
    uint64_t list_count_ = 0;
    uint64_t range_count_ = 0;
    uint32_t range_base_ = 0;
    std::vector<uint64_t> block_ranges_;  ///< Per kCountBlock items.
    gpu::Buffer range_counts_;
    gpu::Buffer ticket_;
    gpu::Buffer unbound_;  ///< Stands in for buffers that a pass does not touch.
    std::vector<Memory> memory_;
};

}  // namespace gnomon
