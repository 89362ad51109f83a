// SPDX-License-Identifier: Apache-2.0
// One row of the benchmark: a scene at a number of samples, by gnomon and by Embree in turn.
#pragma once

#include <functional>
#include <gnomon/render.hpp>
#include <map>
#include <string>
#include <vector>

#include "bench/bench_scenes.hpp"
#include "bench/trials.hpp"
#include "bench/work.hpp"
#include "timing/summary.hpp"

namespace gnomon::bench {

struct Settings {
    uint32_t width = 1024;
    uint32_t height = 768;
    uint32_t shadow_res = 1024;
    uint32_t spp = 8;
    uint32_t threads = 1;  ///< Of Embree, and of the device where it is a CPU.
    uint32_t repeat = 3;   ///< Pairs of timed frames, >= 1.
    std::string pages = RenderSettings().pages;
};

/// Timed frames of one program.
struct Timing {
    timing::Summary wall;                   ///< Seconds.
    timing::Summary cpu;                    ///< Seconds of all cores that the process used meanwhile.
    std::vector<FrameStats::Stage> stages;  ///< Medians.
    timing::Summary rest;                   ///< Wall seconds that lie in no stage: the host's, and waiting for the device.
};

struct Row {
    std::string scene, group;
    double value = 0.0;  ///< As BenchScene::value.
    Settings settings;
    double load_seconds = 0.0;   ///< Of gnomon: Renderer::load.
    double first_seconds = 0.0;  ///< Of gnomon: the first frame, for which the driver compiles.
    std::string refusal;         ///< Why gnomon made no frame; then there is none of its numbers and no ratio.
    Timing gnomon;
    Timing embree;
    timing::Summary ratio;      ///< Embree's wall seconds over gnomon's, pair by pair.
    timing::Summary cpu_ratio;  ///< The same of CPU seconds.
    std::vector<Trial> trials;
    PeerBuild build;          ///< Of the fastest trial.
    PeerRays rays;            ///< Likewise.
    FrameStats gnomon_stats;  ///< Bytes of a timed frame, counts of one that counts ranges.
    std::map<std::string, std::string> effective;
    FrameStats embree_stats;
    Work work;
    Agreement agreement;        ///< Of gnomon with the exact reference.
    PictureErrors peer_errors;  ///< Of the peer against it.
};

/// Told what is about to run.
using Notify = std::function<void(const std::string& what)>;

/// Load the scene, warm up, choose the fastest way to ask Embree, time gnomon and Embree in turn, then run gnomon once more for
/// counts, and the exact reference for the samples that agree. Errors: those of Renderer::render, but for what does not fit
/// into memory, and trace_reference.
Row measure_row(Renderer& renderer, const BenchScene& scene, const PosedScene& posed, const Settings& settings,
                const Notify& notify);

}  // namespace gnomon::bench
