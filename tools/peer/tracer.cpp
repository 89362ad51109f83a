// SPDX-License-Identifier: Apache-2.0
// The samples of one tile of pixels: primary rays, shadow rays, shading, film.
#include "tracer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/sample.h"

namespace gnomon::peer {
namespace {

// Occluders nearer than this share of the hit's largest coordinate do not count. Hit points in float, without a robust test,
// lie a few units in the last place off their triangle.
constexpr float kNearShare = 0x1p-18f;
// Of a shadow ray with the surface: nearer to the surface the tolerance would grow without bound.
constexpr float kLeastCosine = 1e-3f;

// Adds the time between its construction and its end to `seconds`.
class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_;
};

// Every second bit, from the lowest.
uint32_t even_bits(uint32_t bits) {
    uint32_t result = 0;
    for (uint32_t i = 0; i < 16; ++i) result |= (bits >> (2 * i) & 1u) << i;
    return result;
}

}  // namespace

Tracer::Tracer(const World& world) : world_(world), lit_counts_(kTileSize * kTileSize * world.lights.size()) {
    hits_.reserve(kBatch);
}

void Tracer::trace(uint32_t x_px, uint32_t y_px, std::vector<Channel>& channels) {
    const PeerSettings& settings = world_.settings;
    pixels_.clear();
    for (uint32_t i = 0; i < kTileSize * kTileSize; ++i) {
        const uint32_t x = x_px + even_bits(i), y = y_px + even_bits(i >> 1);
        if (x < settings.width && y < settings.height) pixels_.push_back({x, y, shared::pixel_hash(x, y, settings.seed)});
    }
    sums_.assign(pixels_.size(), Sum{});
    std::fill(lit_counts_.begin(), lit_counts_.end(), 0u);
    next_slot_ = next_stratum_ = 0;
    const auto sample_count = static_cast<uint32_t>(pixels_.size()) * settings.spp;
    for (uint32_t first = 0; first < sample_count; first += kBatch) {
        rays_.count = std::min(kBatch, sample_count - first);
        trace_primary();
        for (uint32_t light = 0; light < world_.lights.size(); ++light) trace_shadows(light);
        shade();
    }
    const Stopwatch stopwatch(tally_.shade_seconds);
    write(channels);
}

void Tracer::choose_samples() {
    const bool by_pixels = world_.rays.order == RayOrder::pixels;
    for (uint32_t i = 0; i < rays_.count; ++i) {
        slots_[i] = next_slot_;
        strata_[i] = next_stratum_;
        if (by_pixels) {
            if (++next_slot_ == pixels_.size()) {
                next_slot_ = 0;
                ++next_stratum_;
            }
        } else if (++next_stratum_ == world_.settings.spp) {
            next_stratum_ = 0;
            ++next_slot_;
        }
    }
}

void Tracer::trace_primary() {
    const Stopwatch stopwatch(tally_.primary_seconds);
    choose_samples();
    const float length = shared::stratum_length(world_.settings.spp);
    for (uint32_t i = 0; i < rays_.count; ++i) {
        const Pixel& pixel = pixels_[slots_[i]];
        const glm::vec3 sample = shared::sample_point(pixel.hash, pixel.x, pixel.y, strata_[i], length);
        x_[i] = sample.x;
        y_[i] = sample.y;
        rays_.time[i] = sample.z;
    }
    world_.view.aim(x_.data(), y_.data(), rays_);
    intersect(world_.scene, world_.rays.calls, rays_);

    hits_.clear();
    for (uint32_t i = 0; i < rays_.count; ++i) {
        if (rays_.geometry[i] == RTC_INVALID_GEOMETRY_ID) continue;
        const glm::vec3 direction(rays_.dir_x[i], rays_.dir_y[i], rays_.dir_z[i]);
        const glm::vec3 across(rays_.ng_x[i], rays_.ng_y[i], rays_.ng_z[i]);
        const float scale = 1.0f / std::sqrt(glm::dot(across, across));
        Hit hit;
        hit.depth = rays_.tfar[i];
        hit.point = glm::vec3(rays_.org_x[i], rays_.org_y[i], rays_.org_z[i]) + hit.depth * direction;
        hit.normal = across * (glm::dot(across, direction) > 0.0f ? -scale : scale);
        hit.u = rays_.u[i];
        hit.v = rays_.v[i];
        hit.t = rays_.time[i];
        hit.triangle = rays_.triangle[i];
        hit.slot = slots_[i];
        hit.lit = 0;
        hits_.push_back(hit);
    }
    tally_.hits += hits_.size();
}

void Tracer::trace_shadows(uint32_t light_ix) {
    const Stopwatch stopwatch(tally_.shadow_seconds);
    const PeerLight& light = world_.lights[light_ix];
    const uint32_t bit = 1u << light_ix;
    const float end = light.directional() ? std::numeric_limits<float>::infinity() : 1.0f;
    uint32_t count = 0;
    for (uint32_t i = 0; i < hits_.size(); ++i) {
        Hit& hit = hits_[i];
        hit.lit |= bit;
        if (!light.shadows()) continue;
        const glm::vec3 direction = light.direction(hit.point, hit.t);
        if (!light.directional() && !light.in_cone(direction, hit.t)) continue;
        const glm::vec3 size = glm::abs(hit.point);
        const float speed = std::max(kLeastCosine * (light.directional() ? 1.0f : glm::length(direction)),
                                     std::abs(glm::dot(direction, hit.normal)));
        rays_.org_x[count] = hit.point.x;
        rays_.org_y[count] = hit.point.y;
        rays_.org_z[count] = hit.point.z;
        rays_.dir_x[count] = direction.x;
        rays_.dir_y[count] = direction.y;
        rays_.dir_z[count] = direction.z;
        rays_.tnear[count] = kNearShare * std::max({size.x, size.y, size.z}) / speed;
        rays_.tfar[count] = end;
        rays_.time[count] = hit.t;
        shadowed_[count++] = i;
    }
    rays_.count = count;
    occluded(world_.scene, world_.rays.calls, rays_);
    for (uint32_t i = 0; i < count; ++i) {
        if (rays_.tfar[i] < 0.0f) hits_[shadowed_[i]].lit &= ~bit;
    }
    tally_.shadow_tests += count;
}

void Tracer::shade() {
    const Stopwatch stopwatch(tally_.shade_seconds);
    const size_t light_count = world_.lights.size();
    for (const Hit& hit : hits_) {
        Sum& sum = sums_[hit.slot];
        ++sum.hits;
        sum.depth += hit.depth;
        if (hit.lit == 0) continue;
        const glm::vec3 normal = world_.surface.normal(hit);
        glm::vec3 arriving(0.0f);
        for (size_t light = 0; light < light_count; ++light) {
            if ((hit.lit >> light & 1u) == 0) continue;
            ++lit_counts_[hit.slot * light_count + light];
            arriving += world_.lights[light].arriving(hit, normal);
        }
        if (arriving != glm::vec3(0.0f)) sum.reflected += arriving * world_.surface.albedo(hit) * std::numbers::inv_pi_v<float>;
    }
}

void Tracer::write(std::vector<Channel>& channels) const {
    const PeerSettings& settings = world_.settings;
    const size_t light_count = world_.lights.size();
    const float per_sample = 1.0f / static_cast<float>(settings.spp);
    for (size_t slot = 0; slot < pixels_.size(); ++slot) {
        const Sum& sum = sums_[slot];
        if (sum.hits == 0) continue;
        const size_t at = static_cast<size_t>(pixels_[slot].y) * settings.width + pixels_[slot].x;
        channels[0].values[at] = sum.reflected.x * per_sample;
        channels[1].values[at] = sum.reflected.y * per_sample;
        channels[2].values[at] = sum.reflected.z * per_sample;
        const auto hits = static_cast<float>(sum.hits);
        channels[3].values[at] = hits * per_sample;
        channels[4].values[at] = sum.depth / hits;
        for (size_t light = 0; light < light_count; ++light) {
            const float p = static_cast<float>(lit_counts_[slot * light_count + light]) / hits;
            channels[5 + 2 * light].values[at] = p;
            channels[6 + 2 * light].values[at] = std::sqrt(p * (1.0f - p) / std::max(hits - 1.0f, 1.0f));
        }
    }
}

}  // namespace gnomon::peer
