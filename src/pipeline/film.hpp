// SPDX-License-Identifier: Apache-2.0
// From what the sampler leaves on the device to a frame's channels and samples.
#pragma once

#include <gnomon/render.hpp>
#include <vector>

#include "stages/sample.hpp"

namespace gnomon {

/// Append the channels: means over samples, of depth and visibility over hits. film: planes as in shared/film.h. fractional:
/// visibility is a share of the light, whose squares the film holds.
void resolve(Frame& frame, const std::vector<float>& film, uint32_t spp, bool fractional);

/// Write the samples of a batch that was just shaded into those of the frame.
void keep_samples(Frame& frame, const Sampler& sampler, const Batch& batch, const shared::ViewGrid& grid, uint32_t spp,
                  bool fractional);

}  // namespace gnomon
