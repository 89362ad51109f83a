// SPDX-License-Identifier: Apache-2.0
// Which of the ways to trace a row with Embree is the fastest.
#pragma once

#include <functional>
#include <vector>

#include "bench/bench_scenes.hpp"
#include "peer.hpp"
#include "timing/clocks.hpp"

namespace gnomon::bench {

/// A frame of one variant of the peer.
struct Trial {
    PeerBuild build;
    PeerRays rays;
    timing::Seconds seconds;
    bool whole = false;  ///< Otherwise the tracing is estimated from a part of the tiles; posing and building never are.
};

/// Every build with all rays on a part of the tiles, then the best few on the whole frame, in the order in which they ran.
std::vector<Trial> try_variants(const PeerScene& scene, const std::vector<Pose>& poses, const PeerSettings& settings);

/// The whole frame of the fewest CPU seconds: all variants use all threads, and what else a machine does adds to wall seconds
/// only. trials: with at least one whole frame.
const Trial& fastest(const std::vector<Trial>& trials);

}  // namespace gnomon::bench
