// SPDX-License-Identifier: Apache-2.0
// The options of `gnomon render`, and the frames that they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <gnomon/render.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/report.hpp"
#include "options.hpp"

namespace gnomon::cli {

/// A ground plane; without a height it lies below the scene.
struct GroundOption {
    std::optional<float> height;
};

struct RenderOptions {
    std::string scene;
    std::string exr;
    std::string png;      ///< Empty: none.
    std::string json;     ///< Empty: none. "-": stdout.
    std::string sbuffer;  ///< Empty: none. A file for each light; likewise the next.
    std::string heatmap;
    RenderSettings settings;
    Shutter shutter{0.0, 0.0208333};
    std::optional<FrameRange> frames;
    double fps = 24.0;
    double shutter_angle = 180.0;
    std::string animation = "0";
    std::string camera;  ///< Empty: the first, or the default one.
    uint32_t time_steps = 1;
    std::string device;
    double exposure = 0.0;
    std::optional<GroundOption> ground;
    bool validate = false;
};

/// One frame: when the shutter is open, and the files that it becomes.
struct FrameJob {
    std::optional<uint32_t> number;  ///< In a sequence.
    Shutter shutter;
    std::filesystem::path exr;
    std::optional<std::filesystem::path> png;
    std::string json;  ///< As RenderOptions::json.
    std::optional<std::filesystem::path> sbuffer = {};
    std::optional<std::filesystem::path> heatmap = {};
};

/// Declare the options that say how a scene becomes a picture; `options` must live until the command line is parsed.
void bind_setting_options(CLI::App& command, RenderOptions& options);

/// Those and which scene and layout.
void bind_frame_options(CLI::App& command, RenderOptions& options);

/// Those and the options of outputs and of sequences.
void bind_render_options(CLI::App& command, RenderOptions& options);

/// The frames in order; never empty. Errors: ErrorKind::usage for names with a wrong ending, without #### in a sequence, or
/// with the same file twice.
std::vector<FrameJob> frame_jobs(const RenderOptions& options);

/// Everything that the picture of this frame depends on, and the device with its driver.
io::Json frame_settings(const RenderOptions& options, const RenderSettings& effective, const FrameJob& frame,
                        const std::string& camera_name, const DeviceDescription& device);

}  // namespace gnomon::cli
