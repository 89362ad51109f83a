// SPDX-License-Identifier: Apache-2.0
// Setup and binning: the prisms of a view, listed per tile and cell of time. The same code serves camera and lights.
#pragma once

#include "pipeline/view.hpp"
#include "stages/pose.hpp"

namespace gnomon {

/// The prisms of one view. List of tile and cell: entries [offsets[i], offsets[i + 1]), i = tile * cell_count + cell. An entry
/// is a triangle, with kReversed where its orientation is reversed.
struct Bins {
    shared::ViewGrid grid;
    gpu::Buffer raster_vertices;  ///< vec4 per key and vertex, in the view's raster space.
    gpu::Buffer offsets;
    gpu::Buffer entries;
    uint32_t entry_count = 0;
    uint32_t longest = 0;  ///< Entries of the longest list.
};

/// In which tiles a prism is listed.
enum class Listing {
    swept,   ///< Those that it can touch, in each orientation that it can have there.
    bounds,  ///< All that its bounds touch, once, not reversed.
};

/// Project, bound, count, scan, fill. cell_count: a multiple of the segments.
/// Errors: ErrorKind::out_of_memory.
Bins bin_prisms(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, uint32_t cell_count,
                Listing listing = Listing::swept);

}  // namespace gnomon
