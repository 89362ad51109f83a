// SPDX-License-Identifier: Apache-2.0
// One frame: the one place where the order of the stages can be read.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <gnomon/error.hpp>
#include <gnomon/render.hpp>

#include "layouts/compile_layout.hpp"
#include "methods/method.hpp"
#include "pipeline/film.hpp"
#include "pipeline/memory_plan.hpp"
#include "pipeline/view.hpp"
#include "shared/film.h"
#include "stages/sample.hpp"

namespace gnomon {

struct Renderer::Impl {
    Impl(const std::string& choice, bool validate) : device(choice, validate), programs(device) {}
    gpu::Device device;
    Programs programs;
};

namespace {

constexpr uint32_t kMostLights = 32;

void check_range(const char* option, uint64_t value, uint64_t low, uint64_t high) {
    if (value >= low && value <= high) return;
    throw Error(ErrorKind::usage, std::string(option) + " is " + std::to_string(value), "settings",
                "use " + std::to_string(low) + " to " + std::to_string(high));
}

void check(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings) {
    check_range("width", settings.width, 1, 16384);
    check_range("height", settings.height, 1, 16384);
    check_range("spp", settings.spp, 1, 65536);
    check_range("shadow resolution", settings.shadow_res, 1, 16384);
    check_range("number of poses", poses.size(), 2, 65);
    if (scene.triangles.empty())
        throw Error(ErrorKind::input, "the scene has no triangles", scene.path.string(), "add a mesh with triangles");
    if (settings.camera >= scene.cameras.size()) {
        throw Error(ErrorKind::usage, "there is no camera " + std::to_string(settings.camera), scene.path.string(),
                    "the scene has " + std::to_string(scene.cameras.size()));
    }
    if (scene.lights.size() > kMostLights) {
        throw Error(ErrorKind::input, std::to_string(scene.lights.size()) + " lights", scene.path.string(),
                    "use at most " + std::to_string(kMostLights));
    }
}

// The lights' records, comp_shaders/shared/film.h. A point light contributes nothing yet.
std::vector<glm::vec4> light_records(const Scene& scene, const std::vector<Pose>& poses) {
    std::vector<glm::vec4> records;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        bool spot = light.kind == LightKind::spot;
        glm::vec3 power = light.kind == LightKind::point ? glm::vec3(0.0f) : light.color * light.intensity;
        records.emplace_back(power, std::bit_cast<float>(spot ? shared::kLightSpot : shared::kLightDirectional));
        double inner = std::cos(static_cast<double>(light.inner_cone)), outer = std::cos(static_cast<double>(light.outer_cone));
        double scale = 1.0 / std::max(1e-3, inner - outer);
        records.emplace_back(static_cast<float>(scale), static_cast<float>(-outer * scale), light.range, 0.0f);
        for (const Pose& pose : poses) {
            const Rigid& frame = pose.lights[i];
            records.emplace_back(glm::vec3(frame.translation), 0.0f);
            records.emplace_back(frame.rotation.x, frame.rotation.y, frame.rotation.z, frame.rotation.w);
        }
    }
    if (records.empty()) records.emplace_back(0.0f);
    return records;
}

// Seconds of each stage that went into the lights' maps.
class MapClock {
public:
    explicit MapClock(const gpu::Device& device) : device_(device) {}

    template <class Work>
    void time(Work work) {
        for (const gpu::StageTime& t : device_.stage_times()) seconds_[t.name] -= t.seconds;
        work();
        for (const gpu::StageTime& t : device_.stage_times()) seconds_[t.name] += t.seconds;
    }

    double seconds(const std::string& stage) const {
        const auto found = seconds_.find(stage);
        return found == seconds_.end() ? 0.0 : found->second;
    }

private:
    const gpu::Device& device_;
    std::map<std::string, double> seconds_;
};

// Against each band of the light's map that the batch's samples fall into.
void test_shadows(Sampler& sampler, LightSide& side, const Batch& batch, uint32_t spp, float tolerance, MapClock& clock) {
    const double open = static_cast<double>(batch.stratum_first) / spp;
    const double close = static_cast<double>(batch.stratum_first + batch.stratum_count) / spp;
    for (size_t i = 0; i < side.bands.size(); ++i) {
        const Band& band = side.bands[i];
        if (band.t_close <= open || band.t_open >= close) continue;
        if (side.filled != i) clock.time([&] { side.map->fill(band); });
        side.filled = i;
        sampler.test_shadows(side, band, tolerance);
    }
}

FrameStats statistics(const gpu::Device& device, const MapClock& clock) {
    FrameStats stats;
    for (const gpu::StageTime& t : device.stage_times())
        stats.stages.push_back({t.name, t.seconds, t.dispatches, clock.seconds(t.name)});
    stats.buffer_bytes = device.largest_bytes();
    stats.peak_bytes = device.peak_bytes();
    stats.device = device.description().name;
    return stats;
}

}  // namespace

Renderer::Renderer(const std::string& device, bool validate) : impl_(std::make_unique<Impl>(device, validate)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceDescription& Renderer::device() const { return impl_->device.description(); }

Frame Renderer::render(const Scene& scene, const std::vector<Pose>& poses, const RenderSettings& settings,
                       const Progress& progress) {
    auto start = std::chrono::steady_clock::now();
    check(scene, poses, settings);
    gpu::Device& device = impl_->device;
    Programs& programs = impl_->programs;
    const Method& method = find_method(settings.method);
    check_parameters(method, settings.parameters);
    const std::string raster = choose_raster(method, settings.raster);
    const Layout layout =
        with_ranges(find_layout(settings.layout == "auto" ? method.layout : settings.layout), method.exit_depth);
    if (method.has_s_buffer() && !layout.folder.empty()) {
        std::vector<std::string> stages = {"raster/" + raster, method.shadow_stage};
        if (settings.keep_texel_ranges) stages.emplace_back("raster/texel_ranges");
        for (const std::string& stage : stages) programs.add(layout.stage(stage), compile_stage(stage, layout));
    }
    device.reset_statistics();
    uint64_t budget = settings.memory_budget > 0 ? settings.memory_budget : device.limits().heap_bytes / 2;
    device.set_budget(budget);

    Frame frame;
    frame.width = settings.width;
    frame.height = settings.height;
    frame.light_count = static_cast<uint32_t>(scene.lights.size());
    frame.effective = {{"method", method.name}};
    if (method.has_s_buffer()) frame.effective.insert({{"raster", raster}, {"layout", layout.name}});

    // The scene, posed.
    Bounds bounds = bounds_of(scene, poses);
    Geometry geometry = pose_geometry(device, programs, scene, poses);
    gpu::Buffer lights = gpu::upload_new(device, "lights", light_records(scene, poses));

    // The camera's prisms.
    View view = camera_view(scene.cameras[settings.camera], poses, settings.camera, settings.width, settings.height);
    Bins bins =
        bin_prisms(device, programs, geometry, view, camera_cells(settings.spp, geometry.segment_count, is_still(poses)));

    // Each light's prisms, and what its shadow tests read.
    std::vector<LightSide> sides;
    for (uint32_t i = 0; i < frame.light_count; ++i) {
        if (scene.lights[i].kind == LightKind::point) continue;
        LightSide side;
        side.light_ix = i;
        side.view = light_view(scene.lights[i], poses, i, bounds, settings.shadow_res);
        sides.push_back(std::move(side));
    }
    MapClock map_clock(device);
    std::vector<LightContext> contexts;
    for (const LightSide& side : sides) {
        contexts.push_back({device, programs, geometry, settings, method, side.view, side.light_ix, is_still(poses),
                            budget / sides.size(), layout, raster, &view});
    }
    for (size_t i = 0; i < sides.size(); ++i) {
        LightSide& side = sides[i];
        map_clock.time([&] {
            side.bins = bin_prisms(device, programs, geometry, side.view, method.light_cells(contexts[i]),
                                   raster == "prism" ? Listing::bounds : Listing::swept);
            side.map = method.make_map(contexts[i], side.bins);
        });
        const std::string light = std::to_string(side.light_ix);
        frame.stats.counts["bin_entries." + light] = side.bins.entry_count;
        for (const auto& [name, count] : side.map->counts()) frame.stats.counts[name + "." + light] = count;
        frame.effective["light_cells"] = std::to_string(side.bins.grid.cell_count);
        for (const auto& [name, value] : side.map->effective()) frame.effective[name] = value;
    }

    // The samples, a batch at a time. An S-buffer that fits is filled once, else in bands for every batch.
    frame.effective["camera_cells"] = std::to_string(bins.grid.cell_count);
    uint64_t most_slots = batch_slots(device, bins.grid, settings.spp, budget, method.fractional ? 4 * frame.light_count : 0);
    Sampler sampler(device, programs, geometry, view, bins,
                    {.shadow_stage = method.has_s_buffer() ? layout.stage(method.shadow_stage) : method.shadow_stage,
                     .spp = settings.spp,
                     .seed = settings.seed,
                     .light_count = frame.light_count,
                     .most_slots = most_slots,
                     .fractional = method.fractional,
                     .keep_depths = settings.keep_samples,
                     .count_ranges = settings.count_ranges});
    uint64_t left = budget - std::min(budget, device.live_bytes());
    uint32_t most_strata = settings.spp;
    for (LightSide& side : sides) {
        side.bands = side.map->bands(left / sides.size());
        // Where a map is cut in time, so are the samples, so that it is filled once.
        const double longest = side.bands[0].t_close - side.bands[0].t_open;
        most_strata = std::min(most_strata, static_cast<uint32_t>(std::max(1.0, std::floor(longest * settings.spp))));
    }
    std::vector<Batch> batches = split_batches(bins.grid, settings.spp, most_slots, most_strata);
    for (size_t b = 0; b < batches.size(); ++b) {
        if (progress && !progress(static_cast<double>(b) / static_cast<double>(batches.size()))) break;
        sampler.trace(batches[b]);
        for (LightSide& side : sides) test_shadows(sampler, side, batches[b], settings.spp, least_tolerance(bounds), map_clock);
        sampler.shade(lights, !lights_still(poses));
        if (settings.keep_samples) keep_samples(frame, sampler, batches[b], bins.grid, settings.spp, method.fractional);
    }
    resolve(frame, sampler.film(), settings.spp, method.fractional);
    if (progress) progress(1.0);
    if (settings.keep_texel_ranges) {
        frame.texel_ranges.resize(frame.light_count);
        for (LightSide& side : sides) frame.texel_ranges[side.light_ix] = side.map->texel_ranges(side.bands);
    }

    std::map<std::string, uint64_t> counts = std::move(frame.stats.counts);
    frame.stats = statistics(device, map_clock);
    frame.stats.counts = std::move(counts);
    frame.stats.counts["triangles"] = geometry.triangle_count;
    frame.stats.counts["prisms"] = uint64_t(geometry.triangle_count) * geometry.segment_count;
    frame.stats.counts["bin_entries.camera"] = bins.entry_count;
    frame.stats.counts["samples"] = uint64_t(settings.width) * settings.height * settings.spp;
    frame.stats.counts["hits"] = sampler.hit_count();
    frame.stats.counts["shadow_tests"] = sampler.shadow_counts().cast;
    frame.stats.counts["ranges_visited"] = sampler.shadow_counts().visited;
    frame.stats.counts["ranges_tested"] = sampler.shadow_counts().tested;
    frame.stats.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return frame;
}

}  // namespace gnomon
