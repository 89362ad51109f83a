// SPDX-License-Identifier: Apache-2.0
#include "pipeline/film.hpp"

#include <algorithm>
#include <span>

#include "shared/light.h"

namespace gnomon {

namespace {

// The frame's values of row `row` of the window.
std::span<float> row_of(Frame& frame, Channel& channel, const WindowRect& rect, uint32_t row) {
    return std::span(channel.values).subspan(size_t(rect.first_px.y + row) * frame.width + rect.first_px.x, rect.size_px.x);
}

}  // namespace

void make_channels(Frame& frame) {
    std::vector<std::string> names = {"R", "G", "B", "A", "Z"};
    for (uint32_t light = 0; light < frame.light_count; ++light) {
        names.push_back("visibility." + std::to_string(light));
        names.push_back("visibility_var." + std::to_string(light));
    }
    frame.channels.resize(names.size());
    for (size_t i = 0; i < names.size(); ++i) {
        frame.channels[i].name = names[i];
        frame.channels[i].values.resize(size_t(frame.width) * frame.height);
    }
}

void read_film(gpu::Device& device, const gpu::Buffer& film, Frame& frame, const WindowRect& rect) {
    // Whole rows lie one behind the other in the frame too.
    const uint32_t runs = rect.size_px.x == frame.width ? 1 : rect.size_px.y;
    const size_t run_px = size_t(rect.size_px.x) * rect.size_px.y / runs;
    std::vector<std::span<std::byte>> parts;
    for (Channel& channel : frame.channels) {
        for (uint32_t run = 0; run < runs; ++run)
            parts.push_back(std::as_writable_bytes(std::span(row_of(frame, channel, rect, run).data(), run_px)));
    }
    device.recorder().download(film, parts, 0);
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
