// SPDX-License-Identifier: Apache-2.0
// `gnomon render`: a frame, or a sequence of frames, from a scene.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <gnomon/render.hpp>
#include <memory>

#include "command.hpp"
#include "io/atomic_file.hpp"
#include "io/exr.hpp"
#include "io/heatmap.hpp"
#include "io/png.hpp"
#include "io/sbuffer_file.hpp"
#include "methods/method.hpp"
#include "prepared_scene.hpp"
#include "progress.hpp"
#include "render_options.hpp"

namespace gnomon::cli {

namespace {

void check_outputs(const std::vector<FrameJob>& frames) {
    for (const FrameJob& frame : frames) {
        io::check_writable(frame.exr);
        if (frame.png) io::check_writable(*frame.png);
        if (frame.heatmap) io::check_writable(*frame.heatmap);
        if (frame.sbuffer) io::check_writable(*frame.sbuffer);
        if (!frame.json.empty() && frame.json != "-") io::check_writable(frame.json);
    }
}

void log_statistics(const FrameStats& stats) {
    for (const auto& stage : stats.stages)
        spdlog::debug("{:<24} {:10.6f} s in {} dispatches", stage.name, stage.seconds, stage.dispatches);
    for (const auto& [name, count] : stats.counts) spdlog::debug("{:<24} {:10}", name, count);
    spdlog::debug("{:<24} {:10} bytes", "peak device memory", stats.peak_bytes);
}

/// Light without bounds gives sums without bounds.
void check_finite(const Frame& frame, const std::string& scene) {
    uint64_t not_finite = 0;
    for (const Channel& channel : frame.channels)
        not_finite += static_cast<uint64_t>(
            std::count_if(channel.values.begin(), channel.values.end(), [](float value) { return !std::isfinite(value); }));
    if (not_finite > 0)
        throw Error(ErrorKind::input, fmt::format("{} values of the picture are more than 32-bit floats can hold", not_finite),
                    scene, "lower the intensity of its lights");
}

void write_sbuffers(const Frame& frame, const std::filesystem::path& path, const io::Json& settings,
                    std::vector<std::string>& outputs) {
    std::map<std::string, std::string> attributes = io::exr_attributes(settings, frame.effective);
    for (size_t i = 0; i < frame.light_ranges.size(); ++i) {
        const std::filesystem::path file = light_path(path, i, frame.light_ranges.size());
        attributes["gnomon:light"] = std::to_string(i);
        attributes["gnomon:faces"] = std::to_string(frame.light_ranges[i].faces);
        io::write_sbuffer(file, frame.light_ranges[i], attributes);
        outputs.push_back(file.string());
    }
}

void write_heatmaps(const Frame& frame, uint32_t shadow_res, const std::filesystem::path& path,
                    std::vector<std::string>& outputs) {
    for (size_t i = 0; i < frame.texel_ranges.size(); ++i) {
        const std::filesystem::path file = light_path(path, i, frame.texel_ranges.size());
        const io::Heatmap map = io::heatmap(frame.texel_ranges[i], shadow_res);
        io::write_png(file, map.width, map.height, map.rgb);
        outputs.push_back(file.string());
    }
}

void write_outputs(const Frame& frame, const FrameJob& job, const RenderOptions& options, const io::Json& settings,
                   const std::vector<std::string>& warnings) {
    std::vector<std::string> outputs = {job.exr.string()};
    io::write_exr(job.exr, frame.width, frame.height, frame.channels, io::exr_attributes(settings, frame.effective));
    if (job.png) {
        io::write_png(*job.png, frame.width, frame.height, io::tone_map(frame.channels, options.exposure));
        outputs.push_back(job.png->string());
    }
    if (job.heatmap) write_heatmaps(frame, options.settings.shadow_res, *job.heatmap, outputs);
    if (job.sbuffer) write_sbuffers(frame, *job.sbuffer, settings, outputs);
    if (!job.json.empty()) {
        const io::Json json = io::render_json(frame, settings, outputs, warnings);
        const bool one_of_several = job.json == "-" && job.number;  // Then each is on a line of its own.
        write_json(job.json, json, one_of_several ? -1 : 2);
    }
    spdlog::info("wrote {}; rendered in {:.2f} s", fmt::join(outputs, ", "), frame.stats.wall_seconds);
}

void check_triangles(const Scene& scene) {
    if (scene.triangles.size() > io::kMostDumpedTriangles)
        throw Error(ErrorKind::input,
                    fmt::format("{} triangles, of which a float numbers {}", scene.triangles.size(), io::kMostDumpedTriangles),
                    "--dump-sbuffer", "leave it out");
}

int render(const RenderOptions& options, bool quiet) {
    const std::vector<FrameJob> jobs = frame_jobs(options);
    check_outputs(jobs);

    PreparedScene prepared = prepare_scene(options, jobs);
    const Scene& drawn = prepared.scene;
    RenderSettings& settings = prepared.settings;
    settings.keep_ranges = !options.sbuffer.empty();
    settings.keep_texel_ranges = !options.heatmap.empty();
    if (settings.keep_ranges) check_triangles(drawn);
    if ((settings.keep_ranges || settings.keep_texel_ranges) && settings.pages == "asked")
        spdlog::warn("for {} all pages are made, not those that hits ask for",
                     settings.keep_ranges ? "--dump-sbuffer" : "--heatmap");

    Renderer renderer(options.device, options.validate);
    log_device(renderer.device(), !options.device.empty());

    const double frame_samples = static_cast<double>(settings.width) * settings.height * settings.spp;
    const auto frame_count = static_cast<double>(jobs.size());
    ProgressBar bar(frame_samples * frame_count, quiet);
    int exit_code = kDone;
    const LoadedScene loaded = renderer.load(drawn);
    Frame frame;
    for (size_t i = 0; i < jobs.size(); ++i) {
        const FrameJob& job = jobs[i];
        const std::vector<Pose> poses = prepared.poses(job.shutter, options.time_steps);
        renderer.render(loaded, poses, settings, frame, [&](double share) {
            bar.update((static_cast<double>(i) + share) / frame_count);
            return true;
        });
        bar.erase();

        check_finite(frame, options.scene);
        write_outputs(frame, job, options,
                      frame_settings(options, settings, job, drawn.cameras[settings.camera].name, renderer.device()),
                      drawn.warnings);
        log_statistics(frame.stats);
        if (const uint64_t lost = frame.stats.lost_ranges(); lost > 0) {
            spdlog::warn("the layout {} lost {} ranges: it has a fixed capacity", settings.layout, lost);
            exit_code = kLostEntries;
        }
    }
    return exit_code;
}

}  // namespace

void add_render(CLI::App& app, Invocation& invocation) {
    CLI::App* command = add_command(app, invocation, "render", "Render a frame or a sequence");
    auto options = std::make_shared<RenderOptions>();
    bind_render_options(*command, *options);
    command->callback([&invocation, command, options] {
        invocation.run = [&invocation, command, options] {
            warn_if_unused(*command, "--exposure", "--png");
            warn_if_unused(*command, "--fps", "--frames");
            warn_if_unused(*command, "--shutter-angle", "--frames");
            const std::string& method = options->settings.method;
            for (const char* option : {"--layout", "--dump-sbuffer", "--heatmap"}) {
                if (command->count(option) > 0 && !find_method(method).has_s_buffer())
                    throw Error(ErrorKind::usage, "method " + method + " has no S-buffer", option, "leave it out");
            }
            return render(*options, invocation.quiet);
        };
    });
}

}  // namespace gnomon::cli
