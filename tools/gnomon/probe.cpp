// SPDX-License-Identifier: Apache-2.0
// `gnomon probe`: what a texel of a light's view holds, and what becomes of the samples that ask there.
#include <spdlog/spdlog.h>

#include <filesystem>
#include <gnomon/error.hpp>
#include <limits>
#include <memory>

#include "command.hpp"
#include "depth_time_diagram.hpp"
#include "io/atomic_file.hpp"
#include "methods/method.hpp"
#include "prepared_scene.hpp"
#include "progress.hpp"

namespace gnomon::cli {

namespace {

using io::Json;

struct ProbeOptions {
    RenderOptions render;
    uint32_t light = 0;
    std::optional<Place> texel;
    std::optional<Place> pixel;
    std::string svg;
};

Place parse_place(const std::string& text, const std::string& option) {
    const size_t comma = text.find(',');
    if (comma == std::string::npos)
        throw Error(ErrorKind::usage, "'" + text + "' is no place", option, "give column and row from the top, as in 12,9");
    constexpr uint32_t kMost = std::numeric_limits<int32_t>::max();
    return {parse_count(text.substr(0, comma), option, 0, kMost), parse_count(text.substr(comma + 1), option, 0, kMost)};
}

void check_place(const Place& place, uint32_t width, uint32_t height, const std::string& option) {
    if (place.x < width && place.y < height) return;
    throw Error(ErrorKind::usage, fmt::format("{},{} is outside of {} x {}", place.x, place.y, width, height), option,
                fmt::format("use 0,0 to {},{}", width - 1, height - 1));
}

Json place_json(const Place& place) { return {place.x, place.y}; }

/// The document "gnomon.probe": the texels with their ranges and samples. Times are shares of the shutter, depths metres along
/// the axis of the light's view. turned_away: the light sees the other side of the triangle; of a closed body such a sample is
/// dark without a range. shadowed_by is null of a sample that is lit, of such a one, and where it is a matter of rounding.
Json probe_json(const std::vector<ProbedTexel>& texels, const ProbeOptions& options, bool exit_depths, const Json& settings) {
    Json json = io::document("probe");
    json["settings"] = settings;
    json["light"] = options.light;
    json["pixel"] = options.pixel ? place_json(*options.pixel) : Json(nullptr);
    json["exit_depths"] = exit_depths;
    json["texels"] = Json::array();
    for (const ProbedTexel& texel : texels) {
        Json ranges = Json::array(), samples = Json::array();
        for (const TexelRange& r : texel.ranges)
            ranges.push_back({{"enter", r.enter},
                              {"exit", r.leave},
                              {"depth", r.depth},
                              {"exit_depth", exit_depths ? Json(r.exit_depth) : Json(nullptr)},
                              {"triangle", r.triangle}});
        for (const ProbedSample& s : texel.samples)
            samples.push_back({{"pixel", place_json(s.pixel)},
                               {"sample", s.number},
                               {"time", s.time},
                               {"depth", s.depth},
                               {"triangle", s.triangle},
                               {"lit", s.lit},
                               {"turned_away", s.turned_away},
                               {"shadowed_by", s.shadowed_by ? Json(*s.shadowed_by) : Json(nullptr)},
                               {"shadow_depth", s.shadowed_by ? Json(s.shadow_depth) : Json(nullptr)}});
        json["texels"].push_back({{"texel", place_json(texel.texel)}, {"ranges", ranges}, {"samples", samples}});
    }
    return json;
}

void print_probe(const std::vector<ProbedTexel>& texels) {
    if (texels.empty()) print_line("no sample of the pixel asks the light");
    for (const ProbedTexel& texel : texels) {
        const auto lit = std::count_if(texel.samples.begin(), texel.samples.end(), [](const ProbedSample& s) { return s.lit; });
        print_row(fmt::format("texel {},{}", texel.texel.x, texel.texel.y),
                  fmt::format("{} ranges; {} samples ask, {} lit", texel.ranges.size(), texel.samples.size(), lit));
    }
}

int probe(const ProbeOptions& options, bool quiet) {
    if (!options.svg.empty()) {
        check_ending(options.svg, ".svg", "-o");
        io::check_writable(options.svg);
    }
    const RenderOptions& o = options.render;
    if (!o.json.empty() && o.json != "-") check_ending(o.json, ".json", "--json");
    const FrameJob job{{}, o.shutter, {}, {}, o.json};
    PreparedScene prepared = prepare_scene(o, {job});
    RenderSettings& settings = prepared.settings;
    settings.keep_samples = settings.keep_ranges = true;
    const std::vector<Pose> poses = prepared.poses(o.shutter, o.time_steps);
    const Scene& scene = prepared.scene;
    if (options.light >= scene.lights.size())
        throw Error(ErrorKind::usage, "there is no light " + std::to_string(options.light), "--light",
                    "the scene has " + std::to_string(scene.lights.size()));
    const size_t faces =
        light_faces(scene.lights[options.light], poses, options.light, bounds_of(scene, poses), settings.shadow_res).size();
    if (options.pixel) check_place(*options.pixel, settings.width, settings.height, "--pixel");
    if (options.texel)
        check_place(*options.texel, settings.shadow_res, settings.shadow_res * static_cast<uint32_t>(faces), "--texel");

    Renderer renderer(o.device, o.validate);
    log_device(renderer.device(), !o.device.empty());
    ProgressBar bar(static_cast<double>(settings.width) * settings.height * settings.spp, quiet);
    const Frame frame = renderer.render(scene, poses, settings, [&](double share) {
        bar.update(share);
        return true;
    });
    bar.erase();

    const Probed probed{scene, poses, settings, frame, options.light};
    const std::vector<ProbedTexel> texels =
        options.pixel ? probe_pixel(probed, *options.pixel) : std::vector{probe_texel(probed, *options.texel)};
    const bool exit_depths = frame.light_ranges[options.light].exit_depths;
    const std::string name = std::filesystem::path(o.scene).filename().string();
    if (!options.svg.empty()) {
        const std::string of_pixel = options.pixel ? fmt::format(", pixel {},{}", options.pixel->x, options.pixel->y) : "";
        io::write_file(options.svg, depth_time_diagram(texels, {fmt::format("{}, light {}{}", name, options.light, of_pixel),
                                                                o.shutter.open, o.shutter.close, exit_depths}));
        spdlog::info("wrote {}", options.svg);
    }
    if (!o.json.empty())
        write_json(o.json,
                   probe_json(texels, options, exit_depths,
                              frame_settings(o, settings, job, scene.cameras[settings.camera].name, renderer.device())));
    if (o.json != "-") print_probe(texels);
    return kDone;
}

}  // namespace

void add_probe(CLI::App& app, Invocation& invocation) {
    CLI::App* command =
        add_command(app, invocation, "probe",
                    "Draw what a texel of a light's view holds over time and depth, and the samples of the picture\n"
                    "that ask there. The options of 'gnomon render' say which picture");
    auto options = std::make_shared<ProbeOptions>();
    command->add_option("--light", options->light, "Which light")->type_name("INDEX")->capture_default_str();
    CLI::Option* texel =
        command
            ->add_option_function<std::string>(
                "--texel", [options](const std::string& text) { options->texel = parse_place(text, "--texel"); },
                "Column and row of its view, from the top; of a light with several faces one is below the other")
            ->type_name("X,Y");
    command
        ->add_option_function<std::string>(
            "--pixel", [options](const std::string& text) { options->pixel = parse_place(text, "--pixel"); },
            "Column and row of the picture, from the top: the texels that its samples ask")
        ->type_name("X,Y")
        ->excludes(texel);
    command->add_option("-o,--output", options->svg, "The diagram, of at most eight texels")->type_name("FILE.svg");
    command->add_option("--json", options->render.json, "Write all texels as JSON; - for stdout, instead of the text")
        ->type_name("FILE.json");
    bind_frame_options(*command, options->render);
    command->callback([&invocation, options] {
        invocation.run = [&invocation, options] {
            if (!options->texel && !options->pixel)
                throw Error(ErrorKind::usage, "no place is given", "command line", "use --texel X,Y or --pixel X,Y");
            const std::string& method = options->render.settings.method;
            if (!find_method(method).has_s_buffer())
                throw Error(ErrorKind::usage, "method " + method + " has no S-buffer", "--method",
                            "use exact, dtr, dtr-analytic or temporal");
            return probe(*options, invocation.quiet);
        };
    });
}

}  // namespace gnomon::cli
