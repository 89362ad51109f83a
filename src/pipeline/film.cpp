// SPDX-License-Identifier: Apache-2.0
#include "pipeline/film.hpp"

#include <algorithm>
#include <cmath>

#include "shared/film.h"

namespace gnomon {
namespace {

Channel channel(const std::string& name, const float* plane, size_t pixels) {
    return {name, std::vector<float>(plane, plane + pixels)};
}

}  // namespace

void resolve(Frame& frame, const std::vector<float>& film, uint32_t spp, bool fractional) {
    size_t pixels = size_t(frame.width) * frame.height;
    const char* names[] = {"R", "G", "B", "A", "Z"};
    for (uint32_t plane = 0; plane < shared::kFilmVisibility; ++plane) {
        frame.channels.push_back(channel(names[plane], film.data() + plane * pixels, pixels));
    }
    const float* hits = film.data() + shared::kFilmHits * pixels;
    for (size_t i = 0; i < pixels; ++i) {
        for (uint32_t plane : {shared::kFilmRed, shared::kFilmGreen, shared::kFilmBlue, shared::kFilmHits}) {
            frame.channels[plane].values[i] /= static_cast<float>(spp);
        }
        frame.channels[shared::kFilmDepth].values[i] =
            hits[i] > 0.0f ? frame.channels[shared::kFilmDepth].values[i] / hits[i] : 0.0f;
    }
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        Channel mean =
            channel("visibility." + std::to_string(light), film.data() + (shared::kFilmVisibility + light) * pixels, pixels);
        const size_t squares = (shared::kFilmVisibility + frame.light_count + light) * pixels;
        Channel error{"visibility_var." + std::to_string(light), std::vector<float>(pixels)};
        for (size_t i = 0; i < pixels; ++i) {
            double n = hits[i];
            double p = n > 0.0 ? mean.values[i] / n : 0.0;
            mean.values[i] = static_cast<float>(p);
            double spread = n > 0.0 ? (fractional ? film[squares + i] / n : p) - p * p : 0.0;
            error.values[i] = static_cast<float>(std::sqrt(std::max(0.0, spread) / std::max(n - 1.0, 1.0)));
        }
        frame.channels.push_back(std::move(mean));
        frame.channels.push_back(std::move(error));
    }
}

void keep_samples(Frame& frame, const Sampler& sampler, const Batch& batch, const shared::ViewGrid& grid, uint32_t spp,
                  bool fractional) {
    frame.samples.resize(size_t(frame.width) * frame.height * spp);
    if (fractional) frame.sample_visibility.resize(frame.samples.size() * frame.light_count);
    std::vector<uint32_t> hits = sampler.batch_hits(), lit = sampler.batch_lit();
    std::vector<std::vector<float>> visibility;
    for (uint32_t light = 0; fractional && light < frame.light_count; ++light)
        visibility.push_back(sampler.batch_visibility(light));
    std::vector<float> depths = sampler.batch_depths();
    for (size_t slot = 0; slot < hits.size(); ++slot) {
        const auto [x, y, s] = slot_sample(batch, grid, slot);
        if (x >= frame.width || y >= frame.height || hits[slot] == shared::kNone) continue;
        uint32_t lights = frame.light_count == 32 ? ~0u : (1u << frame.light_count) - 1u;
        const size_t place = (size_t(y) * frame.width + x) * spp + s;
        frame.samples[place] = {hits[slot] & ~shared::kReversed, depths[slot], fractional ? 0u : lit[slot] & lights};
        for (uint32_t light = 0; light < visibility.size(); ++light) {
            frame.sample_visibility[place * frame.light_count + light] = visibility[light][slot];
            frame.samples[place].lit |= visibility[light][slot] >= 0.5f ? 1u << light : 0u;
        }
    }
}

}  // namespace gnomon
