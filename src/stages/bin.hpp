// SPDX-License-Identifier: Apache-2.0
// Setup and binning: the prisms of a view, listed per tile and cell of time. The same code serves camera and lights.
#pragma once

#include <optional>

#include "stages/pose.hpp"
#include "stages/window.hpp"

namespace gnomon {

/// Which of a scene's triangles are listed. In a view that moves nothing stands still.
enum class Part : uint32_t {
    whole = shared::kWholeScene,
    still = shared::kStillPart,    ///< What stands still from the first key to the last: in one cell.
    moving = shared::kMovingPart,  ///< All else.
    apart,  ///< What moves in its cells; what stands still once, in a list behind those of a tile's cells.
};

/// The samples of all pixels (math/sample.h).
struct Lattice {
    uint32_t spp = 1;
    uint32_t seed = 0;
};

/// The prisms of one view, listed in the tiles of a window. List of tile and cell: entries [offsets[i], offsets[i + 1]), i =
/// (tile - window.tile_first) * tile_lists() + cell. An entry is a triangle, with kReversed where its orientation is reversed.
struct Bins {
    shared::ViewGrid grid;
    Part part = Part::whole;
    Window window;
    /// The samples that alone are looked up, where there are such: what is so small that none may meet it is not listed.
    std::optional<Lattice> lattice;
    gpu::Buffer raster_vertices;  ///< vec4 per key and vertex, in the view's raster space.
    gpu::Buffer offsets;
    gpu::Buffer entries;
    uint32_t entry_count = 0;
    uint32_t longest = 0;  ///< Entries of the longest list.
    /// Small prisms that look away from the eye come last in a list, as far as the device keeps order.
    bool facing_first = false;
    /// Lists are put into the order of triangles, which no device keeps: of what walks them every count is then the same in
    /// each run.
    bool in_order = false;

    uint32_t tile_lists() const { return grid.cell_count + (part == Part::apart ? 1 : 0); }
    uint32_t item_count() const { return window.tile_count * tile_lists(); }
};

/// In which tiles a prism is listed.
enum class Listing {
    swept,         ///< Those that it can touch, in each orientation that it can have there.
    facing_first,  ///< As swept; where lists are long, in the order of Bins::facing_first.
    bounds,        ///< All that its bounds touch, once, not reversed.
    casting,  ///< As swept, if it may shadow something: of shells that count as closed only while it looks away from the view's
              ///< eye, of all else what does not stand still on the scene's hull, seen from within.
};

/// Bins without lists: the view's vertices are projected. cell_count: a multiple of the segments; of what stands still, 1.
/// Errors: ErrorKind::out_of_memory.
Bins project_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, uint32_t cell_count,
                    Part part = Part::whole);

class Lister;

/// The lists of a window in the making, instead of those that the bins have: bound, count, fill. The host reads results between
/// the steps, so several views that take them together wait together. The arguments outlive it.
class Binning {
public:
    /// Errors, of every step: ErrorKind::out_of_memory, also where the lists are more than the device can bind.
    Binning(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Window& window,
            Listing listing, Bins& bins);
    ~Binning();
    Binning(Binning&&) noexcept;

    void count();
    void fill();

private:
    void put_in_order();

    gpu::Device& device_;
    Programs& programs_;
    const View& view_;
    Listing listing_;
    Bins& bins_;
    std::unique_ptr<Lister> lister_;
    gpu::Buffer cursors_;  // First the counts.
    gpu::Download total_, longest_;
};

/// All steps.
void list_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Window& window,
                 Listing listing, Bins& bins);

/// Both, for the whole view.
Bins bin_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, uint32_t cell_count,
                Listing listing = Listing::swept, Part part = Part::whole);

}  // namespace gnomon
