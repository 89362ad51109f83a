// SPDX-License-Identifier: Apache-2.0
// What finds the elements of an S-buffer's lists: a stage raster/<name> in two passes, count and fill.
#pragma once

#include <memory>

#include "stages/pages.hpp"
#include "stages/shadow_map.hpp"

namespace gnomon {

/// Its shader takes RasterParams, and binds RasterCounts, the blocks of the layout and `bindings()`.
class RasterStage {
public:
    RasterStage() = default;
    RasterStage(const RasterStage&) = delete;
    RasterStage& operator=(const RasterStage&) = delete;
    virtual ~RasterStage() = default;

    virtual const shared::ViewGrid& grid() const = 0;
    virtual uint32_t item_count() const = 0;
    virtual uint32_t items_per_group() const = 0;
    virtual uint64_t longest() const = 0;     ///< At most so many elements in one list.
    virtual uint32_t part_count() const = 0;  ///< Dispatches that walk the longest source list.
    virtual const char* timing(bool fill) const { return fill ? "raster/fill" : "raster/count"; }
    virtual const gpu::Program& program(bool fill) const = 0;
    virtual std::vector<gpu::Binding> bindings() const = 0;
    virtual std::map<std::string, uint64_t> counts() const { return {}; }  ///< For the report, after the count pass.

    /// Runs of whole blocks of items whose source can be in memory at one time; empty: all items. prepare() makes one's.
    virtual std::vector<Band> portions() const { return {}; }
    virtual void prepare(const Band& /*portion*/) {}
    /// Its lists are each one invocation's (common/write_lists.glsl).
    virtual bool keeps_list_state() const { return true; }
    /// Its items are pages that were asked for.
    virtual bool asked() const { return false; }
    virtual uint64_t source_bytes() const { return 0; }   ///< Of all portions.
    virtual uint32_t fragment_item() const { return 0; }  ///< RasterParams::fragment_item.
    virtual uint32_t entry_first() const { return 0; }    ///< RasterParams::entry_first.
};

/// What a raster stage walks: the lists of all items of the bins' window, or of the pages that were asked for.
struct RasterSource {
    const Geometry& geometry;
    const Bins& bins;
    const Pages* asked = nullptr;

    uint32_t item_count() const { return asked != nullptr ? asked->count() : bins.item_count(); }
    /// Entries of the longest list, and dispatches that walk it, kListChunk entries each.
    uint32_t longest() const { return asked != nullptr ? asked->longest() : bins.longest; }
    uint32_t part_count() const;
    uint32_t entry_first() const { return asked != nullptr ? asked->entry_first() : 0; }
    /// What every stage binds that walks the lists.
    std::vector<gpu::Binding> bindings() const;
    gpu::Binding pages() const;
};

/// raster/conservative or raster/analytic, compiled for a layout: "raster/analytic@array".
std::unique_ptr<RasterStage> walk_bins(Programs& programs, const RasterSource& source, const std::string& shader,
                                       bool orthographic);

}  // namespace gnomon
