// SPDX-License-Identifier: Apache-2.0
// The command `reference`: gnomon's picture by Embree. Options that `gnomon render` has too mean the same here.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <iostream>
#include <optional>

#include "gnomon/additions.hpp"
#include "gnomon/options.hpp"
#include "io/atomic_file.hpp"
#include "io/exr.hpp"
#include "io/report.hpp"
#include "reference.hpp"
#include "tool_main.hpp"

namespace {

using namespace gnomon;

struct Options {
    cli::RenderOptions render;  // Only what the reference has options for is set.
    ReferenceSettings reference;
    std::string size = "1280x720";
    std::string shutter = "0:0.0208333";
    std::optional<std::string> ground;
    bool fast = false, quiet = false;
};

void add_options(CLI::App& app, Options& options) {
    cli::RenderOptions& o = options.render;
    ReferenceSettings& r = options.reference;
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app.add_option("SCENE", o.scene, "Scene, .gltf or .glb")->required()->type_name("");
    app.add_option("-o,--output", o.exr, "Image")->required()->type_name("FILE.exr");
    app.add_option("--json", o.json, "Settings, times and counts; - for stdout")->type_name("FILE.json");
    app.add_option("--size", options.size, "Pixels")->type_name("WxH")->capture_default_str();
    app.add_option("--spp", r.spp, "Samples per pixel")->type_name("N")->capture_default_str();
    app.add_option("--seed", r.seed, "Same seed, same samples")->type_name("S")->capture_default_str();
    app.add_option("--camera", o.camera, "Which camera; without any, one that frames the scene [0]")->type_name("NAME|INDEX");
    app.add_option("--ground", options.ground, "Add a ground: below the scene, or at height Y in metres")->type_name("auto|Y");
    app.add_option("--shutter", options.shutter, "Seconds on the animation clock")
        ->type_name("OPEN:CLOSE")
        ->capture_default_str();
    app.add_option("--animation", o.animation, "Which animation drives the scene")
        ->type_name("NAME|INDEX|all|none")
        ->capture_default_str();
    app.add_option("--time-steps", o.time_steps, "Linear segments of motion between K+1 exact poses")
        ->type_name("K")
        ->check(CLI::Range(1, 128))
        ->capture_default_str();
    app.add_option("--threads", r.threads, "Threads; 0: as many as the hardware runs")->type_name("N")->capture_default_str();
    app.add_option("--embree-segments", r.embree_segments,
                   "Give Embree the motion in at least this many segments; 8 is best for fast motion")
        ->type_name("N")
        ->check(CLI::Range(1, 128))
        ->capture_default_str();
    app.add_flag("--fast", options.fast, "Single precision and no R G B, to measure speed");
    app.add_flag("--quiet", options.quiet, "Only errors on stderr, and no table");
}

io::Json settings_json(const Options& options, const std::string& camera_name) {
    const cli::RenderOptions& o = options.render;
    const ReferenceSettings& r = options.reference;
    io::Json json = {{"method", "reference"},
                     {"exact", r.exact},
                     {"width", r.width},
                     {"height", r.height},
                     {"spp", r.spp},
                     {"seed", r.seed},
                     {"camera", r.camera},
                     {"camera_name", camera_name},
                     {"scene", std::filesystem::path(o.scene).filename().string()},
                     {"animation", o.animation},
                     {"shutter_open", o.shutter.open},
                     {"shutter_close", o.shutter.close},
                     {"time_steps", o.time_steps},
                     {"embree_segments", r.embree_segments},
                     {"version", GNOMON_VERSION}};
    if (o.ground) json["ground"] = o.ground->height ? io::Json(*o.ground->height) : io::Json("auto");
    return json;
}

void print_table(const FrameStats& stats) {
    std::printf("%s\n", stats.device.c_str());
    for (const auto& [name, count] : stats.counts) {
        std::printf("%-16s %12llu\n", name.c_str(), static_cast<unsigned long long>(count));
    }
    for (const FrameStats::Stage& stage : stats.stages) std::printf("%-16s %12.4f s\n", stage.name.c_str(), stage.seconds);
    std::printf("%-16s %12.4f s\n", "wall", stats.wall_seconds);
}

void run(Options options) {
    cli::RenderOptions& o = options.render;
    ReferenceSettings& r = options.reference;
    const cli::Size size = cli::parse_size(options.size, "--size");
    o.settings.width = r.width = size.width;
    o.settings.height = r.height = size.height;
    o.shutter = cli::parse_shutter(options.shutter, "--shutter");
    if (options.ground) o.ground = cli::GroundOption{cli::parse_ground(*options.ground, "--ground")};
    r.exact = !options.fast;
    const bool json_to_stdout = o.json == "-";
    cli::check_ending(o.exr, ".exr", "-o");
    io::check_writable(o.exr);
    if (!o.json.empty() && !json_to_stdout) io::check_writable(o.json);

    Scene scene = load_scene(o.scene);
    const AnimationChoice animation = choose_animation(scene, o.animation);
    if (!o.camera.empty()) r.camera = cli::choose_camera(scene, o.camera);
    const cli::Additions additions(scene, animation, o, {{{}, o.shutter, o.exr, {}, o.json}});
    scene = additions.apply(std::move(scene));
    const std::vector<Pose> poses = pose_scene(scene, animation, o.shutter.open, o.shutter.close, o.time_steps);

    const std::vector<std::string>& warnings = scene.warnings;
    if (!options.quiet) {
        for (const std::string& warning : warnings) std::cerr << "reference: warning: " << printable(warning) << '\n';
    }

    const Frame frame = trace_reference(scene, poses, r);
    const io::Json settings = settings_json(options, scene.cameras[r.camera].name);
    io::write_exr(o.exr, frame.width, frame.height, frame.channels, io::exr_attributes(settings, frame.effective));
    const std::string report = io::to_text(io::render_json(frame, settings, {o.exr}, warnings)) + "\n";
    if (json_to_stdout) {
        std::cout << report;
        return;
    }
    if (!o.json.empty()) io::write_file(o.json, report);
    if (!options.quiet) print_table(frame.stats);
}

}  // namespace

int main(int argc, char** argv) {
    constexpr tools::Tool kTool{"reference",
                                "Traces a motion-blurred frame with Embree, for gnomon's frames to be compared with.",
                                "trace a smaller image or a smaller scene"};
    return tools::tool_main(kTool, argc, argv, add_options, run);
}
