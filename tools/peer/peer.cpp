// SPDX-License-Identifier: Apache-2.0
// The peer, from settings to channels.
#include "peer.hpp"

#include <atomic>
#include <functional>
#include <thread>

#include "embree_scene.hpp"
#include "stopwatch.hpp"
#include "tracer.hpp"
#if defined(__SSE3__)
#include <pmmintrin.h>
#endif

namespace gnomon {
namespace {

using namespace peer;

Motion motion_of(const std::vector<Pose>& poses, std::vector<Rigid> Pose::*list, size_t ix) {
    std::vector<Rigid> keys;
    for (const Pose& pose : poses) keys.push_back((pose.*list)[ix]);
    return Motion(keys);
}

std::vector<PeerLight> lights_of(const Scene& scene, const std::vector<Pose>& poses) {
    std::vector<PeerLight> lights;
    for (size_t i = 0; i < scene.lights.size(); ++i) lights.emplace_back(scene.lights[i], motion_of(poses, &Pose::lights, i));
    return lights;
}

// In the memory of those that there are.
void make_channels(size_t light_count, size_t pixel_count, std::vector<Channel>& channels) {
    std::vector<std::string> names = {"R", "G", "B", "A", "Z"};
    for (size_t i = 0; i < light_count; ++i) {
        names.push_back("visibility." + std::to_string(i));
        names.push_back("visibility_var." + std::to_string(i));
    }
    channels.resize(names.size());
    for (size_t i = 0; i < names.size(); ++i) {
        channels[i].name = names[i];
        channels[i].values.resize(pixel_count);
    }
}

// What Embree's manual asks of threads that trace: denormal numbers are slow.
void flush_denormals() {
#if defined(__SSE3__)
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}

RTCBuildQuality embree_quality(PeerQuality quality) {
    switch (quality) {
        case PeerQuality::low:
            return RTC_BUILD_QUALITY_LOW;
        case PeerQuality::medium:
            return RTC_BUILD_QUALITY_MEDIUM;
        case PeerQuality::high:
            return RTC_BUILD_QUALITY_HIGH;
    }
    return RTC_BUILD_QUALITY_MEDIUM;
}

// The normals of all keys, each key by a thread; none where no vertex has one.
std::vector<std::vector<glm::vec3>> normals_of(const Scene& scene, const Paint& paint, const std::vector<Pose>& poses) {
    if (!paint.smooth) return {};
    std::vector<std::vector<glm::vec3>> normals(poses.size());
    std::vector<std::jthread> threads;
    for (size_t k = 0; k < poses.size(); ++k) {
        threads.emplace_back([&, k] { normals[k] = reference::posed_normals(scene, poses[k]); });
    }
    threads.clear();
    return normals;
}

}  // namespace

std::string name_of(PeerQuality quality) {
    static const char* const names[] = {"low", "medium", "high"};
    return names[static_cast<size_t>(quality)];
}

std::string name_of(RayCalls calls) {
    static const char* const names[] = {"single", "packets of 8", "packets of 16", "stream"};
    return names[static_cast<size_t>(calls)];
}

std::string name_of(RayOrder order) { return order == RayOrder::pixels ? "pixels" : "strata"; }

std::string name_of(const PeerBuild& build) {
    return std::to_string(build.segments) + (build.segments == 1 ? " segment, " : " segments, ") + name_of(build.quality);
}

std::string name_of(const PeerRays& rays) { return name_of(rays.calls) + ", " + name_of(rays.order); }

std::vector<PeerBuild> peer_builds() {
    std::vector<PeerBuild> builds;
    for (const uint32_t segments : {1u, 8u}) {
        for (const PeerQuality quality : {PeerQuality::low, PeerQuality::medium, PeerQuality::high})
            builds.push_back({segments, quality});
    }
    return builds;
}

std::vector<PeerRays> peer_rays() {
    std::vector<PeerRays> all;
    for (const RayOrder order : {RayOrder::pixels, RayOrder::strata}) {
        for (const RayCalls calls : {RayCalls::single, RayCalls::packets_of_8, RayCalls::packets_of_16})
            all.push_back({calls, order});
        if (reference::kHasStreams) all.push_back({RayCalls::stream, order});
    }
    return all;
}

struct PeerScene::Impl {
    const Scene& scene;
    Paint paint;
    RTCDevice embree;
};

PeerScene::PeerScene(const Scene& scene, uint32_t threads)
    : impl_(new Impl{scene, Paint(scene), reference::new_embree(threads, true)}) {}

PeerScene::~PeerScene() { rtcReleaseDevice(impl_->embree); }

struct Peer::Impl {
    Impl(const PeerScene::Impl& loaded, const std::vector<Pose>& poses, const PeerSettings& settings_, const PeerBuild& build)
        : scene(loaded.scene),
          settings(settings_),
          motion(scene, poses),
          normals(normals_of(scene, loaded.paint, poses)),
          view(scene.cameras[settings.camera], motion_of(poses, &Pose::cameras, settings.camera),
               {settings.width, settings.height}),
          lights(lights_of(scene, poses)),
          surface(scene, loaded.paint, normals),
          pose_seconds(clock.lap()),
          embree(motion, {.device = loaded.embree, .least_segments = build.segments, .quality = embree_quality(build.quality)}),
          build_seconds(clock.lap()) {}

    uint32_t across() const { return (settings.width + kTileSize - 1) / kTileSize; }
    uint32_t tile_count() const { return across() * ((settings.height + kTileSize - 1) / kTileSize); }

    // Trace every `step`th tile, from the first.
    Tally trace_tiles(const PeerRays& rays, std::vector<Channel>& channels, uint32_t step) const {
        const World world{settings, rays, embree.scene(), view, lights, surface};
        std::vector<Tally> tallies(settings.threads);
        std::atomic<uint32_t> next = 0;
        const auto work = [&](Tally& tally) {
            flush_denormals();
            const auto tracer = std::make_unique<Tracer>(world);
            for (uint32_t tile = step * next++; tile < tile_count(); tile = step * next++) {
                tracer->trace(tile % across() * kTileSize, tile / across() * kTileSize, channels);
            }
            tally = tracer->tally();
        };
        {
            std::vector<std::jthread> threads;
            for (Tally& tally : tallies) threads.emplace_back(work, std::ref(tally));
        }
        Tally sum;
        for (const Tally& tally : tallies) {
            sum.primary_seconds += tally.primary_seconds;
            sum.shadow_seconds += tally.shadow_seconds;
            sum.shade_seconds += tally.shade_seconds;
            sum.hits += tally.hits;
            sum.shadow_tests += tally.shadow_tests;
        }
        return sum;
    }

    size_t pixel_count() const { return static_cast<size_t>(settings.width) * settings.height; }

    Clock clock;
    const Scene& scene;
    PeerSettings settings;
    reference::SurfaceMotion motion;
    std::vector<std::vector<glm::vec3>> normals;
    View view;
    std::vector<PeerLight> lights;
    Surface surface;
    double pose_seconds;
    reference::EmbreeScene embree;
    double build_seconds;
};

Peer::Peer(const PeerScene& scene, const std::vector<Pose>& poses, const PeerSettings& settings, const PeerBuild& build)
    : impl_(std::make_unique<Impl>(scene.impl(), poses, settings, build)) {}

Peer::~Peer() = default;

double Peer::prepare_seconds() const { return impl_->pose_seconds + impl_->build_seconds; }

void Peer::trace(const PeerRays& rays, Frame& frame) const {
    const PeerSettings& settings = impl_->settings;
    Clock clock;
    frame.width = settings.width;
    frame.height = settings.height;
    frame.light_count = static_cast<uint32_t>(impl_->lights.size());
    make_channels(impl_->lights.size(), impl_->pixel_count(), frame.channels);
    const Tally tally = impl_->trace_tiles(rays, frame.channels, 1);
    const double trace_seconds = clock.lap();

    const double share = trace_seconds / (tally.primary_seconds + tally.shadow_seconds + tally.shade_seconds);
    frame.stats.stages = {{"pose", impl_->pose_seconds},
                          {"build", impl_->build_seconds},
                          {"primary", tally.primary_seconds * share},
                          {"shadow", tally.shadow_seconds * share},
                          {"shade", tally.shade_seconds * share}};
    frame.stats.counts = {{"triangles", impl_->scene.triangles.size()},
                          {"samples", impl_->pixel_count() * settings.spp},
                          {"hits", tally.hits},
                          {"shadow_tests", tally.shadow_tests},
                          {"time_steps", impl_->embree.time_step_count()}};
    frame.stats.wall_seconds = prepare_seconds() + trace_seconds;
    frame.stats.device = "Embree " RTC_VERSION_STRING ", " + std::to_string(settings.threads) + " threads";
}

double Peer::trace_part(const PeerRays& rays, uint32_t step, std::vector<Channel>& scratch) const {
    make_channels(impl_->lights.size(), impl_->pixel_count(), scratch);
    impl_->trace_tiles(rays, scratch, step);
    const uint32_t traced = (impl_->tile_count() + step - 1) / step;
    return static_cast<double>(traced) / impl_->tile_count();
}

void trace_peer(const PeerScene& scene, const std::vector<Pose>& poses, const PeerSettings& settings, const PeerBuild& build,
                const PeerRays& rays, Frame& frame) {
    Peer(scene, poses, settings, build).trace(rays, frame);
}

Frame trace_peer(const Scene& scene, const std::vector<Pose>& poses, const PeerSettings& settings, const PeerBuild& build,
                 const PeerRays& rays) {
    Frame frame;
    trace_peer(PeerScene(scene, settings.threads), poses, settings, build, rays, frame);
    return frame;
}

}  // namespace gnomon
