// SPDX-License-Identifier: Apache-2.0
// Cells of time: into how many equal parts of the shutter a view's prisms are listed, and which of them.
#pragma once

#include <cstdint>

namespace gnomon {

/// Cells of time in which the camera's prisms are listed: a multiple of the segments; where possible a divisor of spp, so that
/// each stratum lies in one cell.
uint32_t camera_cells(uint32_t spp, uint32_t segments, bool still);

/// Cells of time of a light's S-buffer whose ranges may be cut where a cell ends. asked: so many; 0: what is fast.
uint32_t light_cells(uint32_t segments, bool still, uint32_t asked = 0);

/// Whether so many triangles that stand still are better listed apart, once and not in each cell: all triangles are then gone
/// through once more.
bool worth_apart(uint64_t still_triangles, uint64_t triangles, uint32_t cells);

/// Whether it pays to look at the samples of a view's pixels before small prisms are listed: where there are many triangles for
/// its pixels, most are small.
bool worth_sampling(uint64_t triangles, uint64_t pixels);

}  // namespace gnomon
