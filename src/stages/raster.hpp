// SPDX-License-Identifier: Apache-2.0
// The S-buffer of a light's view: all ranges of all texels, in a layout.
#pragma once

#include "layouts/layout.hpp"
#include "stages/bin.hpp"

namespace gnomon {

/// A run of items (a tile in a cell of time) and the ranges of their texels.
struct Band {
    uint32_t item_first = 0;
    uint32_t item_count = 0;
    uint64_t range_first = 0;
    uint64_t range_count = 0;
};

class SBuffer {
public:
    /// Count the ranges of all lists. raster: the stage that finds them ("raster/conservative").
    /// Errors: ErrorKind::out_of_memory where one block of tiles alone is too much for the device.
    SBuffer(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins, const Layout& layout,
            const std::string& raster, bool orthographic);

    uint64_t range_count() const { return range_count_; }
    uint32_t item_count() const { return item_count_; }
    uint64_t list_count() const { return list_count_; }

    /// Bands whose ranges take at most `bytes` each; one, if all of them do. Errors: ErrorKind::out_of_memory, saying how much
    /// a single block needs.
    std::vector<Band> bands(uint64_t bytes) const;

    /// Fill the ranges of a band; those of the band before are forgotten.
    void fill(const Band& band);

    /// What sample/shadow reads, and the number of the range that its memory starts with.
    std::vector<gpu::Binding> read_bindings() const;
    uint32_t range_base() const { return range_base_; }

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
