// SPDX-License-Identifier: Apache-2.0
// Ranges from the triangulated surface of prisms: raster/fragments collects its fragments in linked lists, raster/prism pairs
// them. Source: Hong and Oh 2018, sections 4.1 to 4.3.
#pragma once

#include "stages/s_buffer.hpp"

namespace gnomon {

struct PrismSettings {
    bool orthographic = false;
    bool cull_back_faces = false;           ///< Leave out what is seen from behind at both ends of its segment.
    const gpu::Buffer* coverage = nullptr;  ///< Per list: texels that are not kNone get no fragments.
};

/// raster/prism, compiled for a layout. The bins list prisms by their bounds, in one cell per segment. Fragments take at most
/// `bytes` at one time. Errors: ErrorKind::out_of_memory, where those of a block of items alone take more.
std::unique_ptr<RasterStage> pair_fragments(gpu::Device& device, Programs& programs, const RasterSource& source,
                                            const std::string& shader, const PrismSettings& settings, uint64_t bytes);

}  // namespace gnomon
