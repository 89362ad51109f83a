// SPDX-License-Identifier: Apache-2.0
// `gnomon ranges`: how far the ranges of triangulated prisms are from the true ones, in a light's view of a scene.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <gnomon/error.hpp>

#include "command.hpp"
#include "options.hpp"
#include "range_errors.hpp"

namespace gnomon::cli {
namespace {

using io::Json;

struct Options {
    std::string scene;
    uint32_t light = 0;
    uint32_t shadow_res = 1024;
    std::string shutter = "0:0.0208333";
    std::string animation = "0";
    uint32_t time_steps = 1;
    std::string json;
};

Json spread_json(const Spread& s) { return {{"mean", s.mean}, {"p99", s.p99}, {"max", s.most}}; }

Json errors_json(const RangeErrors& e) {
    return {{"pairs", e.pairs},
            {"missed", e.missed},
            {"invented", e.invented},
            {"several", e.several},
            {"left_over", e.left_over},
            {"true_time", e.true_time},
            {"time_missed", e.time_missed},
            {"time_invented", e.time_invented},
            {"entry_time", spread_json(e.entry_time)},
            {"exit_time", spread_json(e.exit_time)},
            {"entry_depth", spread_json(e.entry_depth)},
            {"exit_depth", spread_json(e.exit_depth)},
            {"linear_depth", spread_json(e.linear_depth)},
            {"prism_depth", spread_json(e.prism_depth)},
            {"prism_depth_texels", spread_json(e.prism_depth_texels)}};
}

void print_spread(const std::string& label, const Spread& s, const std::string& unit) {
    print_row(label, fmt::format("{:.3g} mean, {:.3g} of 99 %, {:.3g} at most, {}", s.mean, s.p99, s.most, unit));
}

void print_errors(const RangeErrors& e) {
    const double pairs = std::max<double>(1.0, static_cast<double>(e.pairs)), time = std::max(1e-30, e.true_time);
    const auto share = [&](uint64_t n) { return fmt::format("{} ({:.3g} %)", n, 100.0 * static_cast<double>(n) / pairs); };
    print_row("triangles in texels", fmt::format("{}, {} with several ranges", e.pairs, share(e.several)));
    print_row("missed, invented",
              fmt::format("{}, {}; {} fragments left over", share(e.missed), share(e.invented), e.left_over));
    print_row("time missed, invented",
              fmt::format("{:.3g} %, {:.3g} %", 100.0 * e.time_missed / time, 100.0 * e.time_invented / time));
    print_spread("time of entry", e.entry_time, "shutters");
    print_spread("time of exit", e.exit_time, "shutters");
    print_spread("depth at entry", e.entry_depth, "m");
    print_spread("depth at exit", e.exit_depth, "m");
    print_spread("linear depth", e.linear_depth, "m, between the true ends");
    print_spread("prism's linear depth", e.prism_depth, "m");
    print_spread("", e.prism_depth_texels, "texels' widths");
}

int ranges(const Options& o) {
    Scene scene = load_scene(o.scene);
    for (const std::string& warning : scene.warnings) spdlog::warn("{}", warning);
    const Shutter shutter = parse_shutter(o.shutter, "--shutter");
    std::vector<Pose> poses =
        pose_scene(scene, choose_animation(scene, o.animation), shutter.open, shutter.close, o.time_steps);
    if (scene.lights.empty()) add_default_light(scene, poses);
    if (o.light >= scene.lights.size()) {
        throw Error(ErrorKind::usage, "there is no light " + std::to_string(o.light), "--light",
                    "the scene has " + std::to_string(scene.lights.size()));
    }
    const Light& light = scene.lights[o.light];
    const RangeErrors errors =
        range_errors(scene, poses, light_faces(light, poses, o.light, bounds_of(scene, poses), o.shadow_res));
    if (!o.json.empty()) write_json(o.json, errors_json(errors));
    if (o.json != "-") print_errors(errors);
    return kDone;
}

}  // namespace

void add_ranges(CLI::App& app, Invocation& invocation) {
    auto o = std::make_shared<Options>();
    CLI::App* command = add_command(app, invocation, "ranges",
                                    "Say how far the ranges of triangulated prisms are from the true ones, in a light's view");
    command->add_option("SCENE", o->scene, "Scene, .gltf or .glb")->required()->type_name("");
    command->add_option("--light", o->light, "Whose view")->type_name("INDEX")->capture_default_str();
    command->add_option("--shadow-res", o->shadow_res, "Texels along the view's side")
        ->check(CLI::Range(1, 16384).description(""))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--shutter", o->shutter, "Seconds on the animation clock")
        ->type_name("OPEN:CLOSE")
        ->capture_default_str();
    command->add_option("--animation", o->animation, "Which animation drives the scene")
        ->type_name("NAME|INDEX|all|none")
        ->capture_default_str();
    command->add_option("--time-steps", o->time_steps, "Linear segments of motion between K+1 exact poses")
        ->check(CLI::Range(1, 128).description(""))
        ->type_name("K")
        ->capture_default_str();
    command->add_option("--json", o->json, "Write it as JSON; - for stdout, instead of the text")->type_name("FILE.json");
    command->callback([&invocation, o] { invocation.run = [o] { return ranges(*o); }; });
}

}  // namespace gnomon::cli
