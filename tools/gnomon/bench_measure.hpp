// SPDX-License-Identifier: Apache-2.0
// The measuring of `gnomon bench`: all layouts of a group in turn, again and again.
#pragma once

#include <functional>

#include "bench_case.hpp"
#include "bench_scene.hpp"

namespace gnomon::cli {

struct BenchLimits {
    uint32_t repetitions = 9;
    double timeout = 0.0;  ///< Seconds of a case, with its warm-up; 0: none.
};

/// Who watches.
struct BenchWatch {
    std::function<void(double frames)> progress;  ///< So many frames of the group are done; with the share of the next.
    std::function<void(const std::string& text)> warn;
};

/// Frames of a group: a warm-up, the repetitions, and one that counts, of each case.
uint32_t frames_of(const BenchGroup& group, const BenchLimits& limits);

/// Render each case once, unmeasured; then all in turn (A B C A B C ...), repetitions times, each in one frame; then count.
/// Of the first case ranges per texel are counted too. What does not fit into memory, what method and layout refuse, and what
/// takes too long is left out from then on, with a warning, and says why in BenchCase::skipped. All other errors are those of
/// Renderer::render.
void measure_group(Renderer& renderer, const BenchScene& scene, const LoadedScene& loaded, const BenchLimits& limits,
                   BenchGroup& group, const BenchWatch& watch);

}  // namespace gnomon::cli
