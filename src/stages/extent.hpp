// SPDX-License-Identifier: Apache-2.0
// Where in a view lies what may shadow something, and how much that is.
#pragma once

#include <vector>

#include "stages/bin.hpp"

namespace gnomon {

struct Extents {
    std::vector<ViewBox> boxes;  ///< At each key; none if at one of them nothing may shadow.
    uint64_t triangles = 0;      ///< Most in a segment.
};

/// Of an orthographic view whose vertices are projected. The host waits.
Extents casting_extents(gpu::Device& device, Programs& programs, const Geometry& geometry, const Bins& bins);

}  // namespace gnomon
