// SPDX-License-Identifier: Apache-2.0
// The samples of one tile of pixels: primary rays, shadow rays, shading, film.
#include "tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/sample.h"
#include "stopwatch.hpp"

namespace gnomon::peer {
namespace {

// Occluders nearer than this share of the hit's largest coordinate do not count. Hit points in float, without a robust test,
// lie a few units in the last place off their triangle.
constexpr float kNearShare = 0x1p-18f;
// Of a shadow ray with the surface: nearer to the surface the tolerance would grow without bound.
constexpr float kLeastCosine = 1e-3f;

// Every second bit, from the lowest.
uint32_t even_bits(uint32_t bits) {
    uint32_t result = 0;
    for (uint32_t i = 0; i < 16; ++i) result |= (bits >> (2 * i) & 1u) << i;
    return result;
}

}  // namespace

Tracer::Tracer(const World& world) : world_(world), lit_counts_(kTileSize * kTileSize * world.lights.size()) {}

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
        begin_shading();
        for (uint32_t light = 0; light < world_.lights.size(); ++light) {
            trace_shadows(light);
            shade(light);
        }
        add_to_film();
    }
    const Stopwatch stopwatch(tally_.shade_seconds);
    write(channels);
}

void Tracer::choose_samples() {
    const bool by_pixels = world_.rays.order == RayOrder::pixels;
    for (uint32_t i = 0; i < rays_.count; ++i) {
        const Pixel& pixel = pixels_[next_slot_];
        slots_[i] = next_slot_;
        strata_[i] = next_stratum_;
        x_px_[i] = pixel.x;
        y_px_[i] = pixel.y;
        hashes_[i] = pixel.hash;
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
        const glm::vec3 sample = shared::sample_point(hashes_[i], x_px_[i], y_px_[i], strata_[i], length);
        x_[i] = sample.x;
        y_[i] = sample.y;
        rays_.time[i] = sample.z;
    }
    world_.view.aim(x_.data(), y_.data(), rays_);
    intersect(world_.scene, world_.rays.calls, rays_);
    find_hits();
    tally_.hits += hits_.count;
}

void Tracer::find_hits() {
    Hits& hits = hits_;
    for (uint32_t i = 0; i < rays_.count; ++i) {
        const float x = rays_.ng_x[i], y = rays_.ng_y[i], z = rays_.ng_z[i];
        const float side = x * rays_.dir_x[i] + y * rays_.dir_y[i] + z * rays_.dir_z[i];
        const float scale = (side > 0.0f ? -1.0f : 1.0f) / std::sqrt(x * x + y * y + z * z);
        hits.normal.x[i] = x * scale;
        hits.normal.y[i] = y * scale;
        hits.normal.z[i] = z * scale;
        hits.point.x[i] = rays_.org_x[i] + rays_.tfar[i] * rays_.dir_x[i];
        hits.point.y[i] = rays_.org_y[i] + rays_.tfar[i] * rays_.dir_y[i];
        hits.point.z[i] = rays_.org_z[i] + rays_.tfar[i] * rays_.dir_z[i];
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < rays_.count; ++i) {
        if (rays_.geometry[i] == RTC_INVALID_GEOMETRY_ID) continue;
        if (count != i) {
            hits.normal.set(count, hits.normal.at(i));
            hits.point.set(count, hits.point.at(i));
        }
        hits.u[count] = rays_.u[i];
        hits.v[count] = rays_.v[i];
        hits.t[count] = rays_.time[i];
        hits.depth[count] = rays_.tfar[i];
        hits.triangle[count] = rays_.triangle[i];
        hits.slot[count] = slots_[i];
        hits.lights[count++] = 0;
    }
    hits.count = count;
}

// Shadow rays of all hits, for a sun that stands still.
uint32_t Tracer::aim_at_sun(const PeerLight& light) {
    const glm::vec3 direction = light.direction({}, 0.0f);
    const Hits& hits = hits_;
    for (uint32_t i = 0; i < hits.count; ++i) {
        const float x = hits.point.x[i], y = hits.point.y[i], z = hits.point.z[i];
        const float speed =
            std::abs(direction.x * hits.normal.x[i] + direction.y * hits.normal.y[i] + direction.z * hits.normal.z[i]);
        rays_.org_x[i] = x;
        rays_.org_y[i] = y;
        rays_.org_z[i] = z;
        rays_.dir_x[i] = direction.x;
        rays_.dir_y[i] = direction.y;
        rays_.dir_z[i] = direction.z;
        rays_.tnear[i] = kNearShare * std::max(std::max(std::abs(x), std::abs(y)), std::abs(z)) / std::max(kLeastCosine, speed);
        rays_.tfar[i] = std::numeric_limits<float>::infinity();
        rays_.time[i] = hits.t[i];
        shadowed_[i] = i;
    }
    return hits.count;
}

// Shadow rays of the hits that the light shines at.
uint32_t Tracer::aim_at(const PeerLight& light) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < hits_.count; ++i) {
        const glm::vec3 point = hits_.point.at(i), size = glm::abs(point);
        const glm::vec3 direction = light.direction(point, hits_.t[i]);
        if (!light.directional() && !light.in_cone(direction, hits_.t[i])) continue;
        const float speed = std::max(kLeastCosine * glm::length(direction), std::abs(glm::dot(direction, hits_.normal.at(i))));
        rays_.org_x[count] = point.x;
        rays_.org_y[count] = point.y;
        rays_.org_z[count] = point.z;
        rays_.dir_x[count] = direction.x;
        rays_.dir_y[count] = direction.y;
        rays_.dir_z[count] = direction.z;
        rays_.tnear[count] = kNearShare * std::max({size.x, size.y, size.z}) / speed;
        rays_.tfar[count] = light.directional() ? std::numeric_limits<float>::infinity() : 1.0f;
        rays_.time[count] = hits_.t[i];
        shadowed_[count++] = i;
    }
    return count;
}

void Tracer::trace_shadows(uint32_t light_ix) {
    const Stopwatch stopwatch(tally_.shadow_seconds);
    const PeerLight& light = world_.lights[light_ix];
    std::fill_n(hits_.lit, hits_.count, 1u);
    rays_.count = light.still_sun() ? aim_at_sun(light) : aim_at(light);
    occluded(world_.scene, world_.rays.calls, rays_);
    for (uint32_t i = 0; i < rays_.count; ++i) {
        if (rays_.tfar[i] < 0.0f) hits_.lit[shadowed_[i]] = 0;
    }
    tally_.shadow_tests += rays_.count;
}

void Tracer::begin_shading() {
    const Stopwatch stopwatch(tally_.shade_seconds);
    world_.surface.get_normals(hits_, normals_);
    std::fill_n(arriving_.x, hits_.count, 0.0f);
    std::fill_n(arriving_.y, hits_.count, 0.0f);
    std::fill_n(arriving_.z, hits_.count, 0.0f);
}

void Tracer::shade(uint32_t light) {
    const Stopwatch stopwatch(tally_.shade_seconds);
    const size_t light_count = world_.lights.size();
    world_.lights[light].add_arriving(hits_, normals_, arriving_);
    for (uint32_t i = 0; i < hits_.count; ++i) {
        hits_.lights[i] += hits_.lit[i];
        lit_counts_[hits_.slot[i] * light_count + light] += hits_.lit[i];
    }
}

void Tracer::add_to_film() {
    const Stopwatch stopwatch(tally_.shade_seconds);
    world_.surface.get_albedos(hits_, albedos_);
    for (uint32_t i = 0; i < hits_.count; ++i) {
        const uint32_t slot = hits_.slot[i];
        Sum& sum = sums_[slot];
        ++sum.hits;
        sum.depth += hits_.depth[i];
        sum.reflected += arriving_.at(i) * albedos_.at(i) * std::numbers::inv_pi_v<float>;
    }
}

void Tracer::write(std::vector<Channel>& channels) const {
    const PeerSettings& settings = world_.settings;
    const size_t light_count = world_.lights.size();
    const float per_sample = 1.0f / static_cast<float>(settings.spp);
    for (size_t slot = 0; slot < pixels_.size(); ++slot) {
        const Sum& sum = sums_[slot];
        const size_t at = static_cast<size_t>(pixels_[slot].y) * settings.width + pixels_[slot].x;
        if (sum.hits == 0) {
            for (Channel& channel : channels) channel.values[at] = 0.0f;
            continue;
        }
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
