// SPDX-License-Identifier: Apache-2.0
// One row of the benchmark: a scene at a number of samples, by gnomon and by the reference in turn.
#pragma once

#include <functional>
#include <gnomon/render.hpp>
#include <map>
#include <string>
#include <vector>

#include "bench/bench_scenes.hpp"
#include "bench/summary.hpp"
#include "bench/work.hpp"

namespace gnomon::bench {

struct Settings {
    uint32_t width = 1024;
    uint32_t height = 768;
    uint32_t shadow_res = 1024;
    uint32_t spp = 8;
    uint32_t threads = 1;  ///< Of the reference, and of the device where it is a CPU.
    uint32_t repeat = 3;   ///< Pairs of timed frames, >= 1.
};

/// Timed frames of one program.
struct Timing {
    Summary wall;                           ///< Seconds.
    Summary cpu;                            ///< Seconds of all cores that the process used meanwhile.
    std::vector<FrameStats::Stage> stages;  ///< Medians.
    Summary rest;                           ///< Wall seconds that lie in no stage: the host's, and waiting for the device.
};

/// The reference with Embree's motion in this many segments, tried once.
struct Trial {
    uint32_t segments = 1;
    double wall_seconds = 0.0;
};

struct Row {
    std::string scene;
    Settings settings;
    Timing gnomon;
    Timing embree;
    Summary ratio;      ///< The reference's wall seconds over gnomon's, pair by pair.
    Summary cpu_ratio;  ///< The same of CPU seconds.
    std::vector<Trial> trials;
    uint32_t embree_segments = 1;  ///< Those of the faster trial.
    FrameStats gnomon_stats;       ///< Bytes of a timed frame, counts of one that counts ranges.
    std::map<std::string, std::string> effective;
    FrameStats embree_stats;
    Work work;
    Agreement agreement;
};

/// Told what is about to run.
using Notify = std::function<void(const std::string& what)>;

/// Warm up, choose the reference's number of segments, time gnomon and the reference in turn, then run both once more for
/// counts and for the samples that agree. Errors: those of Renderer::render and trace_reference.
Row measure_row(Renderer& renderer, const std::string& name, const PosedScene& posed, const Settings& settings,
                const Notify& notify);

}  // namespace gnomon::bench
