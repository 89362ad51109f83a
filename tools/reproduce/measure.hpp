// SPDX-License-Identifier: Apache-2.0
// Renders an experiment and measures it.
#pragma once

#include <cstdint>
#include <functional>
#include <gnomon/render.hpp>
#include <map>
#include <string>
#include <vector>

#include "reproduce/errors.hpp"
#include "reproduce/figure.hpp"

namespace gnomon::reproduce {

struct MeasureOptions {
    double scale = 1.0;            ///< Of the sides of pictures, and of maps but where Experiment::full_maps.
    uint32_t repeat = 3;           ///< Frames of each run, at least 3, with seeds 0, 1, ...
    uint32_t reference_spp = 128;  ///< Of the converged reference.
};

/// Mean seconds of a part of the frame.
struct StageMean {
    std::string name;
    Estimate seconds;
    Estimate map_seconds;  ///< As FrameStats::Stage's.
};

struct RunResult {
    std::map<Metric, Estimate> metrics;
    std::vector<StageMean> stages;
    Frame frame;                                    ///< Of seed 0, without samples.
    std::vector<double> flip;                       ///< Of that frame, per pixel; empty without a reference.
    std::map<Metric, std::vector<double>> by_seed;  ///< Of those metrics that each frame has of its own.
    std::map<Metric, PixelSquares> squares;         ///< Of those metrics that are roots of their mean.
};

struct SettingResult {
    RenderSettings settings;  ///< As rendered: at scale. The method is that of the runs.
    uint64_t triangles = 0;
    Frame converged;              ///< The reference with reference_spp; empty without one.
    Frame same_samples;           ///< The reference with the samples of seed 0.
    std::vector<RunResult> runs;  ///< As Experiment::runs.
};

struct ExperimentResult {
    std::vector<SettingResult> settings;  ///< As Experiment::settings.
};

/// Told, now and then, how many samples were rendered since the last time.
using SamplesDone = std::function<void(double samples)>;

/// All samples of the experiment, those of the reference included.
double sample_count(const Experiment& experiment, const MeasureOptions& options);

/// Runs take turns, seed by seed, after one small frame of each that is not measured.
/// Errors: those of the makers, Renderer::render and trace_reference.
ExperimentResult measure(Renderer& renderer, const Experiment& experiment, const MeasureOptions& options,
                         const SamplesDone& done);

}  // namespace gnomon::reproduce
