// SPDX-License-Identifier: Apache-2.0
// From what the sampler leaves on the device to a frame's channels and samples.
#pragma once

#include <gnomon/render.hpp>
#include <vector>

#include "stages/sample.hpp"

namespace gnomon {

/// The frame's channels, all zero.
void make_channels(Frame& frame);

/// Copy the resolved film of a window to the frame. film: plane-major, in the order of the channels.
void store(Frame& frame, const std::vector<float>& film, const WindowRect& rect);

/// Write the samples of a batch that was just shaded into those of the frame.
void keep_samples(Frame& frame, const Sampler& sampler, const Batch& batch, const shared::ViewGrid& grid, uint32_t spp,
                  bool fractional);

}  // namespace gnomon
