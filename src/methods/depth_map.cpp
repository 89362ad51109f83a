// SPDX-License-Identifier: Apache-2.0
#include "methods/depth_map.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>

#include "math/sample.h"
#include "stages/grid.hpp"

namespace gnomon {

using gpu::Texel;

Parameter bias_parameter() {
    return {"bias",
            "metres",
            "Along the light's axis; what is nearer to a hit than this does not shadow it",
            "two texels' width, a spot's at the hit's depth",
            0,
            1e6};
}

std::vector<Parameter> depth_map_parameters(DepthMapKind kind) {
    if (kind == DepthMapKind::slices)
        return {{"slices", "maps", "Hard shadow maps, each of one time", "3000", 1, 65536, true}, bias_parameter()};
    return {{"map-spp", "samples", "Samples per texel of the map, one in each stratum of the shutter", "the camera's --spp", 1,
             4096, true},
            bias_parameter()};
}

Sampling map_sampling(const LightContext& light, DepthMapKind kind) {
    const bool sliced = kind == DepthMapKind::slices;
    const double spp =
        sliced ? light.parameter("slices").value_or(3000) : light.parameter("map-spp").value_or(light.settings.spp);
    return {static_cast<uint32_t>(spp), shared::light_seed(light.settings.seed, light.light_ix), sliced};
}

std::vector<uint32_t> Bias::constants() const { return {std::bit_cast<uint32_t>(metres), std::bit_cast<uint32_t>(texels)}; }

std::pair<std::string, std::string> AxisLength::effective(const std::string& name) const {
    if (per_metre != 0.0f) return {name + "_per_metre", number_text(static_cast<double>(per_metre))};
    return {name, number_text(static_cast<double>(metres))};
}

AxisLength Bias::length(const View& light) const {
    const float widths = texels / std::min(light.scale_x, light.scale_y);
    return light.orthographic ? AxisLength{metres + widths, 0.0f} : AxisLength{metres, widths};
}

Bias map_bias(const LightContext& light, double texels) {
    if (const std::optional<double> metres = light.parameter("bias")) return {static_cast<float>(*metres), 0.0f};
    // A surface that the light meets at 45 degrees is sqrt(2) texels deeper in one corner of a texel than in the other.
    return {0.0f, static_cast<float>(texels)};
}

std::map<std::string, std::string> map_effective(const LightContext& light, const Sampling& sampling, const Bias& bias) {
    return {{sampling.sliced ? "slices" : "map_spp", std::to_string(sampling.spp)}, bias.length(light.view).effective("bias")};
}

void record_depths(gpu::Recorder& recorder, const LightContext& light, const Bins& bins, Tracer& tracer,
                   const Sampling& sampling, uint32_t floats, const Batch& batch, const gpu::Buffer& samples, uint64_t first) {
    const uint64_t element = floats * sizeof(float);
    tracer.record(recorder, batch);
    recorder.dispatch(
        "map/depth",
        light.programs.get("methods/depth_map/depth", {light.view.orthographic, tracer.straddle(), floats, sampling.sliced}),
        bindings({{"hits", &tracer.hits(), Texel::r32_uint},
                  {"triangles", &light.geometry.scene->triangles, Texel::rgba32_uint},
                  {"raster_vertices", &bins.raster_vertices, Texel::rgba32_float},
                  {"MapSamples", &samples, {}, first * element, batch.slot_count() * element}}),
        shared::MapDepthParams{bins.grid, batch.tile_first, batch.tile_count, batch.stratum_first, batch.stratum_count,
                               sampling.spp, shared::stratum_length(sampling.spp), sampling.seed},
        groups_of(batch.slot_count(), 64));
}

DepthMap::DepthMap(const LightContext& light, const Bins& bins, DepthMapKind kind)
    : light_(light),
      bins_(bins),
      kind_(kind),
      sampling_(map_sampling(light, kind)),
      tile_count_(bins.window.tile_count),
      tracer_(light.device, light.programs, light.geometry, light.view, bins, "map/trace", sampling_,
              uint64_t(tile_count_) * shared::kTileTexels) {
    if (uint64_t(sampling_.spp) * tile_count_ > 0xffffffffull) {
        throw Error(ErrorKind::out_of_memory, std::to_string(sampling_.spp) + " samples in each texel of a light's map",
                    "shadow map", "use fewer of them or a smaller --shadow-res");
    }
}

std::map<std::string, uint64_t> DepthMap::counts() const {
    const uint64_t samples = uint64_t(item_count()) * shared::kTileTexels;
    return {{"map_samples", samples}, {"map_bytes", samples * sample_bytes()}};
}

std::vector<Band> DepthMap::bands(uint64_t bytes) const {
    const uint64_t texels = uint64_t(tile_count_) * shared::kTileTexels, stratum_bytes = texels * sample_bytes();
    const gpu::Limits& limits = light_.device.limits();
    const uint64_t most = std::min({bytes / stratum_bytes, limits.max_storage_range / stratum_bytes,
                                    limits.most_elements(4) / (texels * sample_floats())});
    if (most == 0)
        throw BandTooLarge("the samples of one stratum of a light's map", "shadow map", stratum_bytes, bytes,
                           "a smaller --shadow-res");
    std::vector<Band> result;
    for (uint64_t first = 0; first < sampling_.spp; first += most) {
        const uint64_t count = std::min(most, sampling_.spp - first);
        result.push_back({static_cast<uint32_t>(first * tile_count_), static_cast<uint32_t>(count * tile_count_),
                          first * texels, count * texels, static_cast<double>(first) / sampling_.spp,
                          static_cast<double>(first + count) / sampling_.spp});
    }
    return result;
}

void DepthMap::fill(const Band& band) {
    base_ = static_cast<uint32_t>(band.range_first);
    samples_ = gpu::Buffer();
    samples_ = light_.device.allocate("map_samples", band.range_count * sample_bytes());
    gpu::Recorder& recorder = light_.device.recorder();
    const uint32_t first = band.item_first / tile_count_, count = band.item_count / tile_count_;
    for (uint32_t s = 0; s < count; ++s) {
        record_depths(recorder, light_, bins_, tracer_, sampling_, sample_floats(),
                      {bins_.window.tile_first, tile_count_, first + s, 1}, samples_,
                      uint64_t(s) * tile_count_ * shared::kTileTexels);
    }
}

std::vector<gpu::Binding> DepthMap::read_bindings() const { return {{"map_samples", &samples_, Texel::r32_float}}; }

std::vector<uint32_t> DepthMap::test_constants() const {
    std::vector<uint32_t> all = map_bias(light_).constants();
    all.push_back(motion() ? 1u : 0u);
    return all;
}

}  // namespace gnomon
