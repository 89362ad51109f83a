// SPDX-License-Identifier: Apache-2.0
// From what the sampler leaves on the device to a frame's channels and samples.
#pragma once

#include <gnomon/render.hpp>
#include <vector>

#include "stages/sample.hpp"

namespace gnomon {

/// The frame's channels, in the memory of those that it has. Their values are undefined where they were something else.
void make_channels(Frame& frame);

/// Read a window's film, as Sampler::resolve() leaves it, to the frame. Runs what was recorded.
void read_film(gpu::Device& device, const gpu::Buffer& film, Frame& frame, const WindowRect& rect);

/// Write the samples of a batch that was just shaded into those of the frame.
void keep_samples(Frame& frame, const Sampler& sampler, const Batch& batch, const shared::ViewGrid& grid, uint32_t spp,
                  bool fractional);

}  // namespace gnomon
