// SPDX-License-Identifier: Apache-2.0
// Traces the samples of one tile of pixels at a time: primary rays, shadow rays, film.
#include "tile_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/sample.h"
#include "stopwatch.hpp"

namespace gnomon::reference {
namespace {

constexpr uint32_t kLanes = 8;
constexpr uint32_t kPacketWidth = 4, kPacketHeight = 2;  // Pixels of one packet.
constexpr uint32_t kPacketsAcross = TileTracer::kTileSize / kPacketWidth;
constexpr uint32_t kTilePixels = TileTracer::kTileSize * TileTracer::kTileSize;
constexpr uint32_t kPackets = kTilePixels / kLanes;

// Occluders nearer than this share of the hit's largest coordinate do not count: the tolerance that gnomon has too.
constexpr double kNearShare = 0x1p-20;

// The pixel, in its tile, of lane ix % kLanes of packet ix / kLanes.
glm::uvec2 pixel_of(uint32_t ix) {
    const uint32_t packet = ix / kLanes, lane = ix % kLanes;
    return {packet % kPacketsAcross * kPacketWidth + lane % kPacketWidth,
            packet / kPacketsAcross * kPacketHeight + lane / kPacketWidth};
}

double largest_coordinate(const glm::dvec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

template <class Rays>
void set_ray(Rays& rays, uint32_t lane, const glm::dvec3& origin, const glm::dvec3& direction, double from, double to,
             float t) {
    rays.org_x[lane] = static_cast<float>(origin.x);
    rays.org_y[lane] = static_cast<float>(origin.y);
    rays.org_z[lane] = static_cast<float>(origin.z);
    rays.dir_x[lane] = static_cast<float>(direction.x);
    rays.dir_y[lane] = static_cast<float>(direction.y);
    rays.dir_z[lane] = static_cast<float>(direction.z);
    rays.tnear[lane] = static_cast<float>(from);
    rays.tfar[lane] = static_cast<float>(to);
    rays.time[lane] = t;
    rays.mask[lane] = ~0u;
    rays.id[lane] = lane;
    rays.flags[lane] = 0;
}

// A packet of shadow rays. Embree hands the query back to the filter, so it comes first.
struct ShadowPacket {
    RayQuery query;
    const SurfaceMotion* surface;
    const Hit* hits;
    bool exact;
    double end;  // The light's distance along the rays: 1, or infinity.
    glm::dvec3 direction[kLanes];
};

// Does `occluder`, which Embree found at `distance` along the ray, count?
bool counts(const ShadowPacket& packet, uint32_t lane, uint32_t occluder, double distance) {
    const Hit& hit = packet.hits[lane];
    if (occluder == hit.triangle) return false;
    const glm::dvec3& direction = packet.direction[lane];
    if (packet.exact) {
        const auto [a, b, c] = packet.surface->corners(occluder, hit.when);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double speed = glm::dot(normal, direction);
        // A ray within the occluder's plane has no better distance than Embree's.
        if (speed != 0.0) distance = glm::dot(normal, a - hit.point) / speed;
    }
    return distance < packet.end &&
           distance * std::abs(glm::dot(direction, hit.normal)) >= kNearShare * largest_coordinate(hit.point);
}

}  // namespace

void reject_near_occluders(const RTCFilterFunctionNArguments* args) {
    const auto& packet = *reinterpret_cast<const ShadowPacket*>(args->context);
    for (uint32_t i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const uint32_t lane = RTCRayN_id(args->ray, args->N, i);  // Embree may pass on rays one by one.
        const uint32_t occluder = RTCHitN_primID(args->hit, args->N, i);
        if (!counts(packet, lane, occluder, RTCRayN_tfar(args->ray, args->N, i))) args->valid[i] = 0;
    }
}

TileTracer::TileTracer(const World& world, const ReferenceSettings& settings, Frame& frame)
    : world_(world),
      settings_(settings),
      frame_(frame),
      hits_(kTilePixels),
      lit_(kTilePixels * world.lights.size()),
      sums_(kTilePixels),
      lit_counts_(kTilePixels * world.lights.size()) {}

void TileTracer::trace(uint32_t x_px, uint32_t y_px) {
    x_px_ = x_px;
    y_px_ = y_px;
    std::fill(sums_.begin(), sums_.end(), PixelSum{});
    std::fill(lit_counts_.begin(), lit_counts_.end(), 0u);
    for (uint32_t s = 0; s < settings_.spp; ++s) {
        trace_primary(s);
        for (size_t light = 0; light < world_.lights.size(); ++light) trace_shadows(light);
        add_to_film(s);
    }
}

bool TileTracer::in_image(uint32_t hit_ix) const {
    const glm::uvec2 pixel = pixel_of(hit_ix);
    return x_px_ + pixel.x < settings_.width && y_px_ + pixel.y < settings_.height;
}

void TileTracer::trace_primary(uint32_t s) {
    const Stopwatch stopwatch(tally_.primary_seconds);
    for (uint32_t packet = 0; packet < kPackets; ++packet) trace_packet(packet, s);
}

void TileTracer::trace_packet(uint32_t packet, uint32_t s) {
    alignas(32) int valid[kLanes];
    alignas(32) RTCRayHit8 query;
    CameraRay rays[kLanes];
    Hit* hits = &hits_[packet * kLanes];
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        hits[lane] = Hit{};
        query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        valid[lane] = in_image(packet * kLanes + lane) ? -1 : 0;
        if (valid[lane] == 0) continue;
        const glm::uvec2 pixel = glm::uvec2(x_px_, y_px_) + pixel_of(packet * kLanes + lane);
        const uint32_t hash = shared::pixel_hash(pixel.x, pixel.y, settings_.seed);
        const glm::vec3 sample = shared::sample_point(hash, pixel.x, pixel.y, s, shared::stratum_length(settings_.spp));
        hits[lane].t = sample.z;
        hits[lane].when = key_time(sample.z, world_.surface.segment_count());
        rays[lane] = world_.camera.ray(glm::dvec2(sample), hits[lane].when);
        set_ray(query.ray, lane, rays[lane].origin, rays[lane].direction, world_.camera.near_depth(), world_.camera.far_depth(),
                sample.z);
    }
    RayQuery coherent;
    init(coherent, true);
    intersect(valid, world_.embree.scene(), coherent, query);

    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
        Hit& hit = hits[lane];
        hit.triangle = query.hit.primID[lane];
        hit.u = query.hit.u[lane];
        hit.v = query.hit.v[lane];
        hit.depth = query.ray.tfar[lane];
        glm::dvec3 normal(query.hit.Ng_x[lane], query.hit.Ng_y[lane], query.hit.Ng_z[lane]);
        if (settings_.exact) {
            const auto [a, b, c] = world_.surface.corners(hit.triangle, hit.when);
            normal = glm::cross(b - a, c - a);
            const double speed = glm::dot(normal, rays[lane].direction);
            // A ray within the triangle's plane has no better distance than Embree's.
            if (speed != 0.0) hit.depth = glm::dot(normal, a - rays[lane].origin) / speed;
        }
        hit.normal = glm::normalize(normal);
        hit.point = rays[lane].origin + hit.depth * rays[lane].direction;
        hit.to_eye = -rays[lane].direction;
        ++tally_.hits;
    }
}

void TileTracer::trace_shadows(size_t light_ix) {
    const Stopwatch stopwatch(tally_.shadow_seconds);
    const TracedLight& light = world_.lights[light_ix];
    const size_t light_count = world_.lights.size();
    ShadowPacket packet;
    init(packet.query, true);
    packet.surface = &world_.surface;
    packet.exact = settings_.exact;
    packet.end = light.kind() == LightKind::directional ? std::numeric_limits<double>::infinity() : 1.0;
    for (uint32_t first = 0; first < kTilePixels; first += kLanes) {
        alignas(32) int valid[kLanes] = {};
        alignas(32) RTCRay8 rays;
        packet.hits = &hits_[first];
        uint32_t valid_count = 0;
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            Hit& hit = hits_[first + lane];
            if (hit.triangle == SampleRecord::kMiss) continue;
            lit_[(first + lane) * light_count + light_ix] = 1;
            const std::optional<glm::dvec3> direction = light.shadow_ray(hit);
            if (!direction) continue;
            packet.direction[lane] = *direction;
            set_ray(rays, lane, hit.point, *direction, 0.0, packet.end, hit.t);
            valid[lane] = -1;
            ++valid_count;
        }
        if (valid_count == 0) continue;
        tally_.shadow_tests += valid_count;
        occluded(valid, world_.embree.scene(), packet.query, rays);
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            if (valid[lane] != 0 && rays.tfar[lane] < 0.0f) lit_[(first + lane) * light_count + light_ix] = 0;
        }
    }
}

void TileTracer::add_to_film(uint32_t s) {
    const Stopwatch stopwatch(tally_.shade_seconds);
    const size_t light_count = world_.lights.size();
    for (uint32_t ix = 0; ix < kTilePixels; ++ix) {
        if (!in_image(ix)) continue;
        const Hit& hit = hits_[ix];
        const glm::uvec2 pixel = pixel_of(ix);
        const bool kept = !frame_.samples.empty();
        const size_t image_pixel = static_cast<size_t>(y_px_ + pixel.y) * settings_.width + x_px_ + pixel.x;
        const size_t sample = image_pixel * settings_.spp + s;
        if (kept) frame_.samples[sample] = {hit.triangle, static_cast<float>(hit.depth)};
        if (hit.triangle == SampleRecord::kMiss) continue;
        const std::span<const uint8_t> lit(lit_.data() + ix * light_count, light_count);
        const uint32_t sum_ix = pixel.y * kTileSize + pixel.x;
        PixelSum& sum = sums_[sum_ix];
        ++sum.hits;
        sum.depth += hit.depth;
        if (world_.shading) sum.reflected += world_.shading->reflected(hit, world_.lights, lit);
        for (uint32_t light = 0; light < light_count; ++light) {
            if (lit[light] == 0) continue;
            ++lit_counts_[sum_ix * light_count + light];
            if (kept) frame_.set_lit(sample, light);
        }
    }
}

}  // namespace gnomon::reference
