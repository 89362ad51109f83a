// SPDX-License-Identifier: Apache-2.0
// One frame: the one place where the order of the stages can be read.
#include "pipeline/frame.hpp"

#include <algorithm>
#include <chrono>
#include <gnomon/error.hpp>
#include <numeric>

#include "methods/method.hpp"
#include "pipeline/closed.hpp"
#include "pipeline/film.hpp"
#include "pipeline/light_records.hpp"
#include "pipeline/lights.hpp"
#include "pipeline/memory_plan.hpp"
#include "pipeline/range_collector.hpp"
#include "pipeline/steps.hpp"
#include "shared/film.h"
#include "stages/cells.hpp"
#include "stages/layout_stages.hpp"
#include "stages/read_lists.hpp"
#include "stages/sample.hpp"
#include "views/view.hpp"

namespace gnomon {
namespace {

// Shares of a frame, and of a window, for what comes before the first sample. It may take any; these are seen to move.
constexpr double kPosed = 0.02;
constexpr double kListed = 0.1;

FrameStats statistics(gpu::Device& device) {
    device.recorder().submit();
    FrameStats stats;
    for (const gpu::StageTime& t : device.stage_times())
        stats.stages.push_back({t.name, t.seconds, t.dispatches, t.marked_seconds});
    stats.buffer_bytes = device.largest_bytes();
    stats.peak_bytes = device.peak_bytes();
    stats.timed = device.has_timestamps();
    stats.submissions = device.submissions();
    stats.longest_dispatch = device.longest_dispatch_seconds();
    stats.device = device.description().name;
    stats.driver = device.description().driver;
    return stats;
}

// The prisms of windows[w] of the camera's view, in at most `bytes`. Where they do not fit, the lights go, then the window is
// halved.
void list_window(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view,
                 std::vector<Window>& windows, size_t w, uint64_t budget, uint64_t bytes, Lights& lights, Bins& bins) {
    for (;;) {
        bins.offsets = gpu::Buffer();
        bins.entries = gpu::Buffer();
        device.set_budget(std::min(budget, device.live_bytes() + bytes));
        try {
            list_prisms(device, programs, geometry, view, windows[w], Listing::facing_first, bins);
            device.set_budget(budget);
            return;
        } catch (const Error& error) {
            device.set_budget(budget);
            if (error.kind() != ErrorKind::out_of_memory) throw;
            const bool short_of_budget = device.budget_left() < bytes;
            if (!(short_of_budget && lights.release()) && !halve(windows, w, view)) throw;
        }
    }
}

Layout::Watch watched(const RenderSettings& settings) {
    if (settings.check_layout && settings.count_accesses > 0)
        throw Error(ErrorKind::usage, "a layout's accesses are either checked or counted", "count_accesses",
                    "ask for one of them");
    if (settings.check_layout) return Layout::Watch::faults;
    return settings.count_accesses > 0 ? Layout::Watch::accesses : Layout::Watch::nothing;
}

void make_frame(gpu::Device& device, Programs& programs, const Scene& scene, std::shared_ptr<const SceneData> loaded,
                const std::vector<Pose>& poses, const RenderSettings& settings, const Progress& progress, Frame& frame) {
    auto start = std::chrono::steady_clock::now();
    const Method& method = find_method(settings.method);
    check_parameters(method, settings.parameters);
    check_cells(method, settings.light_cells, static_cast<uint32_t>(poses.size()) - 1);
    const std::string raster = choose_raster(method, settings.raster);
    Layout layout = with_ranges(find_layout(settings.layout == "auto" ? method.layout : settings.layout), method.exit_depth);
    if (method.has_s_buffer()) layout.watch = watched(settings);
    if (method.has_s_buffer()) {
        if (!method.takes(layout)) {
            throw Error(
                ErrorKind::usage,
                "method " + method.name + " needs the very ranges, of which layout " + layout.name + " only contains them",
                "--layout", "use a layout that is lossless, or --method exact");
        }
        std::vector<std::string> stages = {"raster/" + raster, method.shadow_stage};
        if (reads_lists(settings)) stages.push_back(read_lists_stage(method.exit_depth));
        add_layout_stages(device, programs, layout, stages);
    }
    device.reset_statistics();
    uint64_t budget = settings.memory_budget > 0 ? settings.memory_budget : device.limits().heap_bytes / 2;
    check_scene(device, scene, poses.size(), budget);
    device.set_budget(budget);

    frame.samples.clear();
    frame.sample_visibility.clear();
    frame.texel_ranges.clear();
    frame.light_ranges.clear();
    frame.list_lengths.clear();
    frame.width = settings.width;
    frame.height = settings.height;
    frame.light_count = static_cast<uint32_t>(scene.lights.size());
    frame.effective = {{"method", method.name}};
    if (method.has_s_buffer()) frame.effective.insert({{"raster", raster}, {"layout", layout.name}});
    make_channels(frame);

    // The scene, posed.
    Steps steps(device, progress);
    steps.begin(0.0, kPosed);
    if (!loaded) loaded = std::make_shared<SceneData>(upload_scene(device, scene));
    Geometry geometry = pose_geometry(device, programs, std::move(loaded), poses);
    const GeometryBounds boxes = geometry_bounds(device, programs, geometry, scene, poses);
    const Bounds& bounds = boxes.all;
    geometry.box = bounds;
    gpu::Buffer lights = gpu::upload_new(device, "lights", light_records(scene, poses));

    // The camera's vertices and the sampler; then window by window its prisms and samples.
    const View view = camera_view(scene.cameras[settings.camera], poses, settings.camera, settings.width, settings.height);
    check_reach(view, bounds, "the camera", scene.path.string());
    const bool still = is_still(poses);
    const bool one_sided = method.one_sided && settings.closed_meshes;
    uint64_t closed_triangles = 0;
    if (one_sided) {
        const std::vector<uint32_t> closed = closed_shells(scene, poses, boxes, view);
        geometry.closed = gpu::upload_new(device, "closed", closed);
        closed_triangles =
            std::inner_product(closed.begin(), closed.end(), geometry.scene->shell_triangles.begin(), uint64_t{0});
    }
    const uint32_t cells = camera_cells(settings.spp, geometry.segment_count, still);
    const uint32_t still_triangles = gpu::values_of<uint32_t>(device, geometry.still_triangles)[0];
    const bool apart =
        settings.static_once && view.still() && worth_apart(still_triangles, geometry.scene->triangle_count, cells);
    Bins bins = project_prisms(device, programs, geometry, view, cells, apart ? Part::apart : Part::whole);
    if (worth_sampling(geometry.scene->triangle_count, uint64_t(view.width) * view.height))
        bins.lattice = Lattice{settings.spp, settings.seed};
    // What there is to share out: a light's vertices have to fit in as well.
    const uint64_t light_bytes = scene.lights.empty() ? 0 : bins.raster_vertices.bytes();
    const auto left = [&] { return device.budget_left() - std::min(device.budget_left(), light_bytes); };
    const uint64_t room = left();
    const std::string pages = !method.has_s_buffer() ? "" : keeps_ranges(settings) ? "all" : settings.pages;
    const uint64_t most_slots =
        batch_slots(device, view, settings.spp, lit_planes(frame.light_count, method.fractional), pages == "asked", room / 4);
    const std::unique_ptr<LayoutWatch> watch =
        layout.watch == Layout::Watch::nothing
            ? nullptr
            : std::make_unique<LayoutWatch>(device, layout, settings.count_accesses,
                                            programs.spirv(layout.stage(method.shadow_stage)));
    Sampler sampler(device, programs, geometry, view, bins, lights,
                    {.shadow_stage = method.has_s_buffer() ? layout.stage(method.shadow_stage) : method.shadow_stage,
                     .spp = settings.spp,
                     .seed = settings.seed,
                     .light_count = frame.light_count,
                     .most_slots = most_slots,
                     .fractional = method.fractional,
                     .shells = method.one_sided,
                     .one_sided = closed_triangles > 0,
                     .keep_depths = settings.keep_samples,
                     .count_ranges = settings.count_ranges,
                     .watch = watch.get()});
    Lights shadows({device, programs, geometry, settings, method, layout, raster, watch.get(), view, sampler, room, still,
                    pages, one_sided},
                   scene, poses, bounds);
    std::vector<Window> windows = windows_of(view, film_tiles(device, shared::film_planes(frame.light_count), left() / 4));
    const uint64_t camera_bytes = left() / 2;
    uint64_t camera_entries = 0;
    const double all_tiles = double(tiles_across(view)) * tiles_down(view);
    const auto share = [&](const Window& window, double share_of_it) {
        return kPosed + (1.0 - kPosed) * (window.tile_first + share_of_it * window.tile_count) / all_tiles;
    };
    for (size_t w = 0; w < windows.size(); ++w) {
        steps.begin(share(windows[w], 0.0), share(windows[w], kListed));
        list_window(device, programs, geometry, view, windows, w, budget, camera_bytes, shadows, bins);
        camera_entries += bins.entry_count;
        sampler.begin_window();
        if (w == 0) shadows.prepare();
        std::vector<Batch> batches = split_batches(windows[w], settings.spp, most_slots, shadows.most_strata());
        for (size_t b = 0; b < batches.size(); ++b) {
            const auto sampled = [&](size_t done) {
                return share(windows[w], kListed + (1.0 - kListed) * double(done) / double(batches.size()));
            };
            steps.begin(sampled(b), sampled(b + 1));
            sampler.trace(batches[b]);
            while (!shadows.test_shadows(batches[b], can_halve(batches[b]))) {
                halve(batches, b);
                sampler.trace(batches[b]);
            }
            sampler.shade(!lights_still(poses));
            if (b + 1 < batches.size()) device.recorder().submit();  // So that progress is what was done.
            if (settings.keep_samples) keep_samples(frame, sampler, batches[b], bins.grid, settings.spp, method.fractional);
        }
        read_film(device, sampler.resolve(), frame, rect_of(view, windows[w]));
    }
    const auto found_faults = [&] { return watch ? watch->faults() : std::vector<LayoutFault>(); };
    frame.layout_faults = found_faults();
    frame.layout_accesses = watch ? watch->accesses() : std::nullopt;
    // What a layout gives whose walks do not end is nothing to keep.
    if (reads_lists(settings) && frame.layout_faults.empty()) {
        shadows.read_ranges(frame);
        frame.layout_faults = found_faults();
    }

    const uint64_t hits = sampler.hit_count();
    const uint64_t tests = settings.count_ranges ? sampler.test_count() : 0;  // The last work before the statistics.
    frame.stats = statistics(device);
    shadows.report(frame);
    frame.effective["camera_cells"] = std::to_string(bins.grid.cell_count);
    frame.stats.counts["triangles"] = geometry.scene->triangle_count;
    frame.stats.counts["closed_triangles"] = closed_triangles;
    frame.stats.counts["still_triangles"] = still_triangles;
    frame.stats.counts["prisms"] = uint64_t(geometry.scene->triangle_count) * geometry.segment_count;
    frame.stats.counts["bin_entries.camera"] = camera_entries;
    frame.stats.counts["samples"] = uint64_t(settings.width) * settings.height * settings.spp;
    frame.stats.counts["hits"] = hits;
    if (settings.count_ranges) {
        frame.stats.counts["camera_tests"] = tests;
        frame.stats.counts["shadow_tests"] = sampler.shadow_counts().cast;
        frame.stats.counts["ranges_visited"] = sampler.shadow_counts().visited;
        frame.stats.counts["ranges_tested"] = sampler.shadow_counts().tested;
    } else {
        frame.stats.counts["shadow_tests"] = hits * frame.light_count;  // One for each.
    }
    frame.stats.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void render_frame(gpu::Device& device, Programs& programs, const Scene& scene, std::shared_ptr<const SceneData> loaded,
                  const std::vector<Pose>& poses, const RenderSettings& settings, const Progress& progress, Frame& frame) {
    try {
        make_frame(device, programs, scene, std::move(loaded), poses, settings, progress, frame);
    } catch (const Steps::Stopped&) {
        for (Channel& channel : frame.channels) std::ranges::fill(channel.values, 0.0f);
        return;
    }
    if (progress) progress(1.0);
}

}  // namespace gnomon
