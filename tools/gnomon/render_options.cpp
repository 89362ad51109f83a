// SPDX-License-Identifier: Apache-2.0
// The options of `gnomon render`, and the frames that they ask for.
#include "render_options.hpp"

#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <limits>

#include "methods/method.hpp"

namespace gnomon::cli {

namespace {

/// An option whose text goes through a parser of options.hpp.
template <class Parse>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& type, const std::string& default_text,
                        const std::string& description, Parse parse) {
    CLI::Option* option = command.add_option_function<std::string>(
        name, [name, parse](const std::string& text) { parse(text, name); }, description);
    option->type_name(type);
    if (!default_text.empty()) option->default_str(default_text);
    return option;
}

/// One option for each parameter of any method.
void add_parameters(CLI::App& command, std::map<std::string, double>& values) {
    std::map<std::string, Parameter> all;
    for (const Method& method : methods()) {
        for (const Parameter& parameter : method.parameters) {
            Parameter& known = all.emplace(parameter.name, parameter).first->second;
            known.least = std::min(known.least, parameter.least);
            known.most = std::max(known.most, parameter.most);
        }
    }
    for (const auto& [name, p] : all) {
        add_parsed(command, "--" + name, "X", "", p.summary + " [" + p.initial + "]",
                   [&values, parameter = p](const std::string& text, const std::string& option) {
                       values[parameter.name] = parse_number(text, option, parameter.least, parameter.most);
                   })
            ->group("Method, see 'gnomon methods'");
    }
}

constexpr const char* kTime = "Time";
constexpr const char* kPicture = "Picture";
constexpr const char* kMachine = "Machine";
using Text = const std::string&;

}  // namespace

void bind_frame_options(CLI::App& command, RenderOptions& options) {
    command.add_option("SCENE", options.scene, "Scene, .gltf or .glb")->required()->type_name("");
    command.add_option("--layout", options.settings.layout, "S-buffer layout")
        ->type_name("NAME|FOLDER")
        ->capture_default_str()
        ->group(kPicture);
    bind_setting_options(command, options);
}

void bind_setting_options(CLI::App& command, RenderOptions& options) {
    RenderOptions& o = options;
    add_parsed(command, "--size", "WxH", "1280x720", "Pixels", [&o](Text text, Text name) {
        const Size size = parse_size(text, name);
        o.settings.width = size.width;
        o.settings.height = size.height;
    })->group(kPicture);
    add_parsed(command, "--spp", "N", "16", "Samples per pixel", [&o](Text text, Text name) {
        o.settings.spp = parse_count(text, name, 1, 65536);
    })->group(kPicture);
    add_parsed(command, "--seed", "S", "0", "Same seed, same bits, on the same device", [&o](Text text, Text name) {
        o.settings.seed = parse_count(text, name, 0, std::numeric_limits<uint32_t>::max());
    })->group(kPicture);
    command.add_option("--camera", o.camera, "Which camera; without any, one that frames the scene [0]")
        ->type_name("NAME|INDEX")
        ->group(kPicture);
    add_parsed(command, "--ground", "auto|Y", "", "Add a ground: below the scene, or at height Y in metres",
               [&o](Text text, Text name) { o.ground = GroundOption{parse_ground(text, name)}; })
        ->group(kPicture);
    command.add_option("--method", o.settings.method, "How shadows are found")
        ->type_name("NAME")
        ->capture_default_str()
        ->group(kPicture);
    command.add_option("--raster", o.settings.raster, "How ranges are found: analytic, conservative, prism; auto is by method")
        ->type_name("NAME")
        ->check(CLI::IsMember({"auto", "analytic", "conservative", "prism"}).description(""))
        ->capture_default_str()
        ->group(kPicture);
    command
        .add_option("--pages", o.settings.pages,
                    "Of an S-buffer are made: all its pages, or those that hits ask for; auto: asked where lists are long")
        ->type_name("auto|asked|all")
        ->check(CLI::IsMember({"auto", "asked", "all"}).description(""))
        ->capture_default_str()
        ->group(kPicture);
    add_parsed(command, "--shadow-res", "N", "1024", "Texels along a light view's side; of a sun's at most, for exact",
               [&o](Text text, Text name) { o.settings.shadow_res = parse_count(text, name, 1, 16384); })
        ->group(kPicture);

    add_parsed(command, "--cells", "N", "",
               "Cells of time of a light's S-buffer, a multiple of --time-steps; only of exact [what is fast]",
               [&o](Text text, Text name) { o.settings.light_cells = parse_count(text, name, 1, kMostSegments); })
        ->group(kPicture);

    command
        .add_flag("!--no-closed-meshes", o.settings.closed_meshes,
                  "List both sides of closed meshes, and all that shadows nothing; the picture is the same but for rounding")
        ->group(kPicture);
    command
        .add_flag("!--no-static-once", o.settings.static_once,
                  "List what stands still in each cell of time, not once; the picture is the same")
        ->group(kPicture);

    add_parameters(command, o.settings.parameters);

    add_parsed(command, "--shutter", "OPEN:CLOSE", "0:0.0208333", "Seconds on the animation clock", [&o](Text text, Text name) {
        o.shutter = parse_shutter(text, name);
    })->group(kTime);
    command.add_option("--animation", o.animation, "Which animation drives the scene")
        ->type_name("NAME|INDEX|all|none")
        ->capture_default_str()
        ->group(kTime);
    add_parsed(command, "--time-steps", "K", "1", "Linear segments of motion between K+1 exact poses, at most 128",
               [&o](Text text, Text name) { o.time_steps = parse_count(text, name, 1, kMostSegments); })
        ->group(kTime);

    command.add_option("--device", o.device, "Which Vulkan device [the first hardware device, else a CPU]")
        ->type_name("NAME|INDEX|cpu|gpu")
        ->group(kMachine);
    add_parsed(command, "--memory-budget", "SIZE", "", "Most device memory, as in 512M or 1.5GiB [half the device's heap]",
               [&o](Text text, Text name) { o.settings.memory_budget = parse_bytes(text, name); })
        ->group(kMachine);
    command.add_flag("--validate", o.validate, "Run under the Vulkan validation layer; its messages are errors")
        ->group(kMachine);
}

void bind_render_options(CLI::App& command, RenderOptions& options) {
    RenderOptions& o = options;
    const std::string output = "Output";
    command.add_option("-o,--output", o.exr, "Image; for sequences its name has ####")
        ->required()
        ->type_name("FILE.exr")
        ->group(output);
    command.add_option("--png", o.png, "The same picture, sRGB 8 bit")->type_name("FILE.png")->group(output);
    add_parsed(command, "--exposure", "EV", "0", "The PNG is brighter by 2^EV", [&o](Text text, Text name) {
        o.exposure = parse_number(text, name, -100.0, 100.0);
    })->group(output);
    command.add_option("--json", o.json, "Settings, times, memory and counts; - for stdout")
        ->type_name("FILE.json")
        ->group(output);
    command
        .add_option("--dump-sbuffer", o.sbuffer,
                    "All ranges of all texels as a deep image, see 'gnomon sbuffer'; of several lights FILE.light<i>.exr")
        ->type_name("FILE.exr")
        ->group(output);
    command
        .add_option("--heatmap", o.heatmap,
                    "How many ranges each texel of the lights' views has, with a scale; of several lights FILE.light<i>.png")
        ->type_name("FILE.png")
        ->group(output);

    bind_frame_options(command, options);
    add_parsed(command, "--frames", "A-B", "", "A sequence: frame n opens at n/F for (D/360)/F seconds",
               [&o](Text text, Text name) { o.frames = parse_frames(text, name); })
        ->excludes(command.get_option("--shutter"))
        ->group(kTime);
    add_parsed(command, "--fps", "F", "24", "Frames per second of a sequence", [&o](Text text, Text name) {
        o.fps = parse_number(text, name, 1e-6, 1e6);
    })->group(kTime);
    add_parsed(command, "--shutter-angle", "D", "180", "Degrees, 0 to 360, of a sequence", [&o](Text text, Text name) {
        o.shutter_angle = parse_number(text, name, 0.0, 360.0);
    })->group(kTime);
}

std::vector<FrameJob> frame_jobs(const RenderOptions& options) {
    const bool writes_json = !options.json.empty() && options.json != "-";
    check_ending(options.exr, ".exr", "-o");
    if (!options.png.empty()) check_ending(options.png, ".png", "--png");
    if (writes_json) check_ending(options.json, ".json", "--json");
    if (!options.sbuffer.empty()) check_ending(options.sbuffer, ".exr", "--dump-sbuffer");
    if (!options.heatmap.empty()) check_ending(options.heatmap, ".png", "--heatmap");
    if (!options.heatmap.empty() && options.heatmap == options.png)
        throw Error(ErrorKind::usage, "the picture and the heat map have the same file", "--heatmap", "name another");
    if (!options.sbuffer.empty() && options.sbuffer == options.exr)
        throw Error(ErrorKind::usage, "the picture and the S-buffer have the same file", "--dump-sbuffer", "name another");

    if (!options.frames) {
        FrameJob still{{}, options.shutter, options.exr, {}, options.json};
        if (!options.png.empty()) still.png = options.png;
        if (!options.sbuffer.empty()) still.sbuffer = options.sbuffer;
        if (!options.heatmap.empty()) still.heatmap = options.heatmap;
        return {still};
    }
    std::vector<FrameJob> frames;
    for (uint64_t number = options.frames->first; number <= options.frames->last; ++number) {
        const auto n = static_cast<uint32_t>(number);
        FrameJob frame{n, {}, numbered_path(options.exr, n, "-o"), {}, options.json};
        frame.shutter = {n / options.fps, (n + options.shutter_angle / 360.0) / options.fps};
        if (!options.png.empty()) frame.png = numbered_path(options.png, n, "--png");
        if (!options.heatmap.empty()) frame.heatmap = numbered_path(options.heatmap, n, "--heatmap");
        if (!options.sbuffer.empty()) frame.sbuffer = numbered_path(options.sbuffer, n, "--dump-sbuffer");
        if (writes_json) frame.json = numbered_path(options.json, n, "--json").string();
        frames.push_back(frame);
    }
    return frames;
}

io::Json frame_settings(const RenderOptions& options, const RenderSettings& effective, const FrameJob& frame,
                        const std::string& camera_name, const DeviceDescription& device) {
    io::Json settings = io::settings_json(effective);
    settings["camera_name"] = camera_name;
    settings["scene"] = std::filesystem::path(options.scene).filename().string();
    settings["animation"] = options.animation;
    settings["shutter_open"] = frame.shutter.open;
    settings["shutter_close"] = frame.shutter.close;
    settings["time_steps"] = options.time_steps;
    if (frame.number) {
        settings["frame"] = *frame.number;
        settings["fps"] = options.fps;
        settings["shutter_angle"] = options.shutter_angle;
    }
    if (options.ground) settings["ground"] = options.ground->height ? io::Json(*options.ground->height) : io::Json("auto");
    if (frame.png) settings["exposure"] = options.exposure;
    if (frame.sbuffer || frame.heatmap) settings["all_ranges"] = true;
    settings["device"] = device.name;
    settings["driver"] = device.driver;
    settings["version"] = GNOMON_VERSION;
    return settings;
}

}  // namespace gnomon::cli
