// SPDX-License-Identifier: Apache-2.0
// The reference, from settings to channels.
#include "reference.hpp"

#include <atomic>
#include <cmath>
#include <gnomon/error.hpp>
#include <optional>
#include <thread>

#include "stopwatch.hpp"
#include "tile_tracer.hpp"

namespace gnomon {
namespace {

using namespace reference;

constexpr uint32_t kTileSize = TileTracer::kTileSize;

void check_range(const char* name, uint32_t value, uint32_t least, uint32_t most) {
    if (value >= least && value <= most) return;
    throw Error(ErrorKind::usage, std::string(name) + " is " + std::to_string(value), "settings of the reference",
                "choose " + std::to_string(least) + " to " + std::to_string(most));
}

void check(const Scene& scene, const std::vector<Pose>& poses, const ReferenceSettings& settings) {
    check_range("width", settings.width, 1, 16384);
    check_range("height", settings.height, 1, 16384);
    check_range("samples per pixel", settings.spp, 1, 65536);
    check_range("threads", settings.threads, 0, 1024);
    check_range("Embree segments", settings.embree_segments, 1, RTC_MAX_TIME_STEP_COUNT - 1);
    check_range("the number of poses", static_cast<uint32_t>(poses.size()), 2, RTC_MAX_TIME_STEP_COUNT);
    if (settings.camera >= scene.cameras.size()) {
        throw Error(ErrorKind::usage, "there is no camera " + std::to_string(settings.camera), scene.path.string(),
                    "the scene has " + std::to_string(scene.cameras.size()));
    }
}

// The motion of one camera or light through all poses.
RigidMotion motion_of(const std::vector<Pose>& poses, std::vector<Rigid> Pose::*list, size_t ix) {
    std::vector<Rigid> keys;
    for (const Pose& pose : poses) keys.push_back((pose.*list)[ix]);
    return RigidMotion(keys);
}

// Channel numbers; those of lights come in pairs after these.
struct ChannelList {
    explicit ChannelList(bool shaded) : first(shaded ? 3 : 0) {}
    size_t first;
    size_t alpha() const { return first; }
    size_t depth() const { return first + 1; }
    size_t visibility(size_t light) const { return first + 2 + 2 * light; }
    size_t visibility_var(size_t light) const { return first + 3 + 2 * light; }
};

std::vector<Channel> empty_channels(bool shaded, size_t light_count, size_t pixel_count) {
    std::vector<std::string> names;
    if (shaded) names = {"R", "G", "B"};
    names.insert(names.end(), {"A", "Z"});
    for (size_t i = 0; i < light_count; ++i) {
        names.push_back("visibility." + std::to_string(i));
        names.push_back("visibility_var." + std::to_string(i));
    }
    std::vector<Channel> channels;
    for (const std::string& name : names) channels.push_back({name, std::vector<float>(pixel_count)});
    return channels;
}

void resolve_pixel(Frame& frame, const TileTracer& tracer, uint32_t tile_pixel, size_t frame_pixel,
                   const ReferenceSettings& settings) {
    const auto set = [&](size_t channel, double value) {
        frame.channels[channel].values[frame_pixel] = static_cast<float>(value);
    };
    const ChannelList list(settings.exact);
    const PixelSum& sum = tracer.sum(tile_pixel);
    for (glm::length_t i = 0; settings.exact && i < 3; ++i) set(static_cast<size_t>(i), sum.reflected[i] / settings.spp);
    set(list.alpha(), static_cast<double>(sum.hits) / settings.spp);
    if (sum.hits == 0) return;
    set(list.depth(), sum.depth / sum.hits);
    for (size_t light = 0; light < frame.light_count; ++light) {
        const double p = static_cast<double>(tracer.lit_count(tile_pixel, light)) / sum.hits;
        set(list.visibility(light), p);
        set(list.visibility_var(light), std::sqrt(p * (1.0 - p) / std::max(sum.hits - 1, 1u)));
    }
}

// Tiles go to whichever thread is free; a pixel's sum is one thread's, in order of its samples, so it does not matter which.
TraceTally trace_tiles(Frame& frame, const World& world, const ReferenceSettings& settings, uint32_t thread_count) {
    const uint32_t across = (settings.width + kTileSize - 1) / kTileSize;
    const uint32_t down = (settings.height + kTileSize - 1) / kTileSize;
    std::vector<TileTracer> tracers(thread_count, TileTracer(world, settings, frame));
    std::atomic<uint32_t> next_tile = 0;
    const auto work = [&](TileTracer& tracer) {
        for (uint32_t tile = next_tile++; tile < across * down; tile = next_tile++) {
            const uint32_t x0 = tile % across * kTileSize, y0 = tile / across * kTileSize;
            tracer.trace(x0, y0);
            for (uint32_t y = y0; y < std::min(y0 + kTileSize, settings.height); ++y) {
                for (uint32_t x = x0; x < std::min(x0 + kTileSize, settings.width); ++x) {
                    resolve_pixel(frame, tracer, (y - y0) * kTileSize + (x - x0), static_cast<size_t>(y) * settings.width + x,
                                  settings);
                }
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (TileTracer& tracer : tracers) threads.emplace_back(work, std::ref(tracer));
    }
    TraceTally sum;
    for (const TileTracer& tracer : tracers) {
        sum.primary_seconds += tracer.tally().primary_seconds;
        sum.shadow_seconds += tracer.tally().shadow_seconds;
        sum.shade_seconds += tracer.tally().shade_seconds;
        sum.hits += tracer.tally().hits;
        sum.shadow_tests += tracer.tally().shadow_tests;
    }
    return sum;
}

}  // namespace

Frame trace_reference(const Scene& scene, const std::vector<Pose>& poses, const ReferenceSettings& settings) {
    check(scene, poses, settings);
    const uint32_t thread_count = settings.threads > 0 ? settings.threads : std::max(1u, std::thread::hardware_concurrency());
    const size_t pixel_count = static_cast<size_t>(settings.width) * settings.height;
    Frame frame;
    frame.width = settings.width;
    frame.height = settings.height;
    frame.light_count = static_cast<uint32_t>(scene.lights.size());
    frame.channels = empty_channels(settings.exact, scene.lights.size(), pixel_count);
    if (settings.keep_samples) frame.keep_samples(pixel_count * settings.spp);

    Clock clock;
    const SurfaceMotion surface(scene, poses);
    std::optional<Shading> shading;
    if (settings.exact) shading.emplace(scene, poses);
    const double pose_seconds = clock.lap();
    const EmbreeScene embree(surface, {.least_segments = settings.embree_segments,
                                       .threads = thread_count,
                                       .robust = true,
                                       .occluded_filter = reject_near_occluders});
    const double build_seconds = clock.lap();

    const CameraView camera(scene.cameras[settings.camera], motion_of(poses, &Pose::cameras, settings.camera),
                            {settings.width, settings.height});
    World world{surface, embree, camera, {}, std::move(shading)};
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        world.lights.emplace_back(scene.lights[i], motion_of(poses, &Pose::lights, i));
    }
    const TraceTally tally = trace_tiles(frame, world, settings, thread_count);
    const double trace_seconds = clock.lap();

    const double share = trace_seconds / (tally.primary_seconds + tally.shadow_seconds + tally.shade_seconds);
    frame.stats.stages = {{"pose", pose_seconds, 0},
                          {"build", build_seconds, 0},
                          {"primary", tally.primary_seconds * share, 0},
                          {"shadow", tally.shadow_seconds * share, 0},
                          {"shade", tally.shade_seconds * share, 0}};
    frame.stats.counts = {{"triangles", scene.triangles.size()},
                          {"samples", pixel_count * settings.spp},
                          {"hits", tally.hits},
                          {"shadow_tests", tally.shadow_tests},
                          {"time_steps", embree.time_step_count()}};
    frame.stats.wall_seconds = pose_seconds + build_seconds + trace_seconds;
    frame.stats.device = "Embree " RTC_VERSION_STRING ", " + std::to_string(thread_count) + " threads";
    return frame;
}

}  // namespace gnomon
