// SPDX-License-Identifier: Apache-2.0
// The nearest map and the coverage map of a light's view: which triangle covers a texel's centre for the whole of its segment,
// with nothing nearer. Source: Hong and Oh 2017, Extension.
#pragma once

#include "stages/raster_stage.hpp"

namespace gnomon {

/// One uint32_t for each texel and segment, in the order of an S-buffer's lists.
struct CoverageMap {
    gpu::Buffer nearest_depths;     ///< What the passes leave: of a covered texel the depth where its triangle goes.
    gpu::Buffer nearest_triangles;  ///< Of the nearest fragment of any prism; shared::kNone: there is none.
    gpu::Buffer coverage;           ///< The covering triangle, or shared::kNone.
    uint64_t covered = 0;           ///< Texels with one.

    uint64_t bytes() const { return nearest_depths.bytes() + nearest_triangles.bytes() + coverage.bytes(); }
};

/// The bins list prisms by their bounds, in one cell per segment.
CoverageMap make_coverage(gpu::Device& device, Programs& programs, const RasterSource& source, bool orthographic,
                          bool cull_back_faces);

}  // namespace gnomon
