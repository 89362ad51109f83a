// SPDX-License-Identifier: Apache-2.0
// How a frame is cut up: cells of time, batches of samples.
#pragma once

#include <gnomon/scene.hpp>
#include <vector>

#include "stages/sample.hpp"

namespace gnomon {

/// Nothing moves between the poses: no vertex, camera or light.
bool is_still(const std::vector<Pose>& poses);

/// No light moves or turns between the poses.
bool lights_still(const std::vector<Pose>& poses);

/// Cells of time in which the camera's prisms are listed: a multiple of the segments; where possible a divisor of spp, so that
/// each stratum lies in one cell.
uint32_t camera_cells(uint32_t spp, uint32_t segments, bool still);

/// Cells of time of a light's S-buffer whose ranges may be cut where a cell ends.
uint32_t light_cells(uint32_t segments, bool still);

/// Most slots of one batch, so that its buffers fit into the budget and into one binding. visibility_bytes: of a slot, of
/// methods that give shares.
uint64_t batch_slots(const gpu::Device& device, const shared::ViewGrid& grid, uint32_t spp, uint64_t budget,
                     uint64_t visibility_bytes);

/// Batches that cover every tile and stratum once, of at most `most_strata` strata; for each tile the strata in order.
std::vector<Batch> split_batches(const shared::ViewGrid& grid, uint32_t spp, uint64_t most_slots, uint32_t most_strata = ~0u);

}  // namespace gnomon
