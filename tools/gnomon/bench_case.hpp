// SPDX-License-Identifier: Apache-2.0
// What `gnomon bench` measures: cases, in groups that differ in the layout alone.
#pragma once

#include <gnomon/error.hpp>
#include <gnomon/render.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {

/// What is varied besides the layout: {"shadow-res", "256"}, ..., in the order of the command line.
using AxisValues = std::vector<std::pair<std::string, std::string>>;

/// "shadow-res=256", with a separator between several.
std::string axes_text(const AxisValues& axes, const std::string& separator);

struct BenchLayout {
    std::string asked;  ///< The name or folder of the command line.
    std::string name;   ///< Of the manifest.
    bool lossless = true;
    bool compared = true;  ///< With the baseline; not the floor that nobody asked for.
    bool again = false;    ///< The baseline a second time: what differs then is noise.
};

/// Ranges per texel, summed over cells of time and over squares of texels, at most kMost of these across.
struct TexelGrid {
    static constexpr uint32_t kMost = 128;
    uint32_t width = 0;  ///< 0: not counted.
    uint32_t height = 0;
    std::vector<uint64_t> ranges;
};

/// A layout in a scene at a point of the axes.
struct BenchCase {
    std::string name;  ///< "scene/layout/shadow-res=256"
    BenchLayout layout;
    std::map<std::string, std::vector<double>> samples;  ///< Milliseconds of each repetition, by metric (bench_metrics()).
    std::map<std::string, double> counts;
    std::vector<uint64_t> lengths;  ///< How many lists have so many ranges, by that number; empty: not counted.
    TexelGrid texels;
    std::optional<bool> same_picture;  ///< Of a lossless layout: as that of the group's first, bit for bit.
    double seconds = 0.0;              ///< That it took so far, all in all.
    std::string skipped;               ///< Why there are no samples; then also as which error.
    ErrorKind skipped_as = ErrorKind::usage;
};

/// All layouts in a scene at a point of the axes; the baseline is the first.
struct BenchGroup {
    std::string scene;
    AxisValues axes;
    RenderSettings settings;  ///< But for the layout.
    double speed = 1.0;
    uint32_t time_steps = 1;
    std::vector<BenchCase> cases;

    /// "scene, shadow-res=256"
    std::string text() const { return axes.empty() ? scene : scene + ", " + axes_text(axes, ", "); }
};

struct Axis {
    std::string name;
    std::vector<std::string> values;
};

/// Everything that came out of a run.
struct BenchResults {
    DeviceDescription device;
    std::vector<std::string> command;  ///< Its arguments, from the program's name on.
    uint32_t repetitions = 0;
    uint32_t seed = 0;
    std::vector<BenchLayout> layouts;  ///< The baseline is the first; without that again.
    std::vector<Axis> axes;
    RenderSettings settings;  ///< Where no axis says otherwise.
    double copy_bytes_per_second = 0.0;
    std::vector<BenchGroup> groups;
};

/// A part of a frame that is timed, and the stages of which it is.
struct BenchMetric {
    std::string name;
    std::vector<std::string> stages;
};

/// clear, count, scan, prepare, fill, finish, query: what stages take. Besides there are "build" (all of these but query),
/// "frame" (wall time), "rest" (of the frame, what is neither build nor query), and "cpu" (of all cores, of this process).
const std::vector<BenchMetric>& bench_stages();

/// All of them in the order of reports.
const std::vector<std::string>& bench_metrics();

/// Those that are compared.
inline constexpr const char* kCompared[] = {"build", "query", "frame"};

/// Milliseconds by metric, of a frame and the CPU seconds of this process during it. Without timestamps frame and cpu only.
std::map<std::string, double> metrics_of(const FrameStats& stats, double cpu_seconds);

}  // namespace gnomon::cli
