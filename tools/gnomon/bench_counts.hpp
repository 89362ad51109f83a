// SPDX-License-Identifier: Apache-2.0
// What is counted of a case, once, outside of the time that is measured.
#pragma once

#include "bench_case.hpp"
#include "bench_scene.hpp"

namespace gnomon::cli {

/// Counts of a frame, summed over lights; "peak_bytes".
std::map<std::string, double> counts_of(const FrameStats& stats);

/// What is counted of a layout's accesses, as means of a query, or a group, and shares.
std::map<std::string, double> counts_of(const LayoutAccesses& accesses);

/// A map of `width` texels a row, brought down to TexelGrid::kMost of them by adding up squares.
TexelGrid texel_grid(const std::vector<uint32_t>& ranges, uint32_t width);

/// Fill counts, lengths and, if asked for, texels. timed: one of the frames that were; where counting takes away what was
/// timed, as pages do that are asked for, that stays as it was. Errors: as of Renderer::render.
void count_case(Renderer& renderer, const LoadedScene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                const Frame& timed, bool texels, BenchCase& counted);

}  // namespace gnomon::cli
