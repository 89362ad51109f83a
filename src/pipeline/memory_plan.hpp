// SPDX-License-Identifier: Apache-2.0
// What a frame needs, and how it is cut up: cells of time, windows, batches of samples.
#pragma once

#include <gnomon/scene.hpp>
#include <vector>

#include "stages/sample.hpp"

namespace gnomon {

/// That no invocation has to go round a loop too often for the scene. Errors: ErrorKind::input.
void check_turns(const Scene& scene);

/// That the scene's own data can be bound and fits into the budget, beside a little to work with; everything else is cut to
/// fit. Errors: ErrorKind::out_of_memory, saying how much would do.
void check_scene(const gpu::Device& device, const Scene& scene, uint64_t keys, uint64_t budget);

/// Nothing moves between the poses: no vertex, camera or light.
bool is_still(const std::vector<Pose>& poses);

/// No light moves or turns between the poses.
bool lights_still(const std::vector<Pose>& poses);

/// Most slots of one batch, so that its buffers take at most `bytes` and fit into one binding. lit_planes: words that say
/// which lights reach a slot; asks: hits ask for pages.
uint64_t batch_slots(const gpu::Device& device, const View& view, uint32_t spp, uint32_t lit_planes, bool asks, uint64_t bytes);

/// Most tiles of a window of the camera's view, so that its film takes at most `bytes` and fits into one binding.
uint64_t film_tiles(const gpu::Device& device, uint32_t planes, uint64_t bytes);

/// Batches that cover every tile and stratum of the window once, of at most `most_strata` strata; for each tile the strata in
/// order.
std::vector<Batch> split_batches(const Window& window, uint32_t spp, uint64_t most_slots, uint32_t most_strata);

/// Batches of more than one tile and stratum.
bool can_halve(const Batch& batch);
/// Those from `first` on that can be halved, in the same order: by their tiles, else by their strata.
void halve(std::vector<Batch>& batches, size_t first);

}  // namespace gnomon
