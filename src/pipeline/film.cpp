// SPDX-License-Identifier: Apache-2.0
#include "pipeline/film.hpp"

#include <algorithm>

#include "shared/light.h"

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
    frame.keep_samples(size_t(frame.width) * frame.height * spp);
    if (fractional) frame.sample_visibility.resize(frame.samples.size() * frame.light_count);
    const std::vector<uint32_t> hits = sampler.batch_hits();
    std::vector<std::vector<float>> visibility;
    std::vector<std::vector<uint32_t>> lit;
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        if (fractional) visibility.push_back(sampler.batch_visibility(light));
        if (!fractional && light % 32 == 0) lit.push_back(sampler.batch_lit(shared::lit_word(light)));
    }
    const std::vector<float> depths = sampler.batch_depths();
    for (size_t slot = 0; slot < hits.size(); ++slot) {
        const auto [x, y, s] = slot_sample(batch, grid, slot);
        if (x >= frame.width || y >= frame.height || hits[slot] == shared::kNone) continue;
        const size_t place = (size_t(y) * frame.width + x) * spp + s;
        frame.samples[place] = {hits[slot] & ~shared::kReversed, depths[slot], 0u};
        for (uint32_t light = 0; light < frame.light_count; ++light) {
            if (fractional) frame.sample_visibility[place * frame.light_count + light] = visibility[light][slot];
            const bool reached = fractional ? visibility[light][slot] >= 0.5f
                                            : (lit[shared::lit_word(light)][slot] >> shared::lit_bit(light) & 1u) != 0;
            if (reached) frame.set_lit(place, light);
        }
    }
}

}  // namespace gnomon
