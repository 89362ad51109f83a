// SPDX-License-Identifier: Apache-2.0
#include "pipeline/film.hpp"

#include <algorithm>

namespace gnomon {

void make_channels(Frame& frame) {
    std::vector<std::string> names = {"R", "G", "B", "A", "Z"};
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        names.push_back("visibility." + std::to_string(light));
        names.push_back("visibility_var." + std::to_string(light));
    }
    const size_t pixels = size_t(frame.width) * frame.height;
    for (const std::string& name : names) frame.channels.push_back({name, std::vector<float>(pixels)});
}

void store(Frame& frame, const std::vector<float>& film, const WindowRect& rect) {
    auto from = film.begin();
    for (Channel& channel : frame.channels) {
        for (uint32_t row = 0; row < rect.size_px.y; ++row, from += rect.size_px.x) {
            const size_t place = size_t(rect.first_px.y + row) * frame.width + rect.first_px.x;
            std::copy_n(from, rect.size_px.x, channel.values.begin() + static_cast<std::ptrdiff_t>(place));
        }
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
