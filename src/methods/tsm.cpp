// SPDX-License-Identifier: Apache-2.0
#include "methods/tsm.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>
#include <sstream>

#include "math/sample.h"
#include "stages/grid.hpp"

namespace gnomon {

using gpu::Texel;

std::vector<Parameter> tsm_parameters() {
    return {{"map-spp", "samples", "Samples per texel of the map, one in each stratum of the shutter", "the camera's --spp", 1,
             4096, true},
            {"bias", "metres", "Along the light's axis; what is nearer to a hit than this does not shadow it",
             "two texels' width; a spot's at a distance of the scene's diagonal", 0, 1e6}};
}

uint32_t map_spp(const LightContext& light) {
    return static_cast<uint32_t>(light.parameter("map-spp").value_or(light.settings.spp));
}

float map_bias(const LightContext& light) {
    // A surface that the light meets at 45 degrees is sqrt(2) texels deeper in one corner of a texel than in the other.
    const double diagonal = glm::length(glm::dvec3(light.bounds.upper) - glm::dvec3(light.bounds.lower));
    const double texel = (light.view.orthographic ? 1.0 : diagonal) / std::min(light.view.scale_x, light.view.scale_y);
    return static_cast<float>(light.parameter("bias").value_or(2.0 * texel));
}

uint32_t map_seed(const LightContext& light) {
    return shared::hash_pcg(light.settings.seed ^ shared::hash_pcg(light.light_ix + 1));
}

TimeDependentMap::TimeDependentMap(const LightContext& light, const Bins& bins, bool motion)
    : light_(light),
      bins_(bins),
      motion_(motion),
      spp_(map_spp(light)),
      seed_(map_seed(light)),
      tile_count_(bins.grid.tiles_x * bins.grid.tiles_y),
      tracer_(light.device, light.programs, light.geometry, light.view, bins, "tsm/trace", spp_, seed_,
              uint64_t(tile_count_) * shared::kTileTexels) {
    if (uint64_t(spp_) * tile_count_ > 0xffffffffull) {
        throw Error(ErrorKind::out_of_memory, std::to_string(spp_) + " samples in each texel of a light's map", "shadow map",
                    "use a smaller --map-spp or --shadow-res");
    }
}

std::map<std::string, uint64_t> TimeDependentMap::counts() const {
    return {{"map_samples", uint64_t(item_count()) * shared::kTileTexels}};
}

std::map<std::string, std::string> TimeDependentMap::effective() const {
    std::ostringstream bias;
    bias << map_bias(light_);
    return {{"map_spp", std::to_string(spp_)}, {"bias", bias.str()}};
}

std::vector<Band> TimeDependentMap::bands(uint64_t bytes) const {
    const uint64_t texels = uint64_t(tile_count_) * shared::kTileTexels, stratum_bytes = texels * sample_bytes();
    const gpu::Limits& limits = light_.device.limits();
    const uint64_t most =
        std::min({bytes / stratum_bytes, limits.max_storage_range / stratum_bytes, limits.max_texels / texels});
    if (most == 0) {
        throw Error(ErrorKind::out_of_memory, "one stratum of a light's map takes " + std::to_string(stratum_bytes) + " bytes",
                    "shadow map", "allow a larger --memory-budget or use a smaller --shadow-res");
    }
    std::vector<Band> result;
    for (uint64_t first = 0; first < spp_; first += most) {
        const uint64_t count = std::min(most, spp_ - first);
        result.push_back({static_cast<uint32_t>(first * tile_count_), static_cast<uint32_t>(count * tile_count_),
                          first * texels, count * texels, static_cast<double>(first) / spp_,
                          static_cast<double>(first + count) / spp_});
    }
    return result;
}

void TimeDependentMap::fill(const Band& band) {
    base_ = static_cast<uint32_t>(band.range_first);
    samples_ = gpu::Buffer();
    samples_ = light_.device.allocate("map_samples", band.range_count * sample_bytes());
    gpu::Recorder recorder(light_.device);
    const uint32_t first = band.item_first / tile_count_, count = band.item_count / tile_count_;
    const uint32_t texels = tile_count_ * shared::kTileTexels;
    for (uint32_t s = 0; s < count; ++s) {
        tracer_.record(recorder, {0, tile_count_, first + s, 1});
        recorder.dispatch("tsm/depth",
                          light_.programs.get("methods/tsm/depth", {light_.view.orthographic, tracer_.straddle(), motion_}),
                          bindings({{"hits", &tracer_.hits(), Texel::r32_uint},
                                    {"triangles", &light_.geometry.triangles, Texel::rgba32_uint},
                                    {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                                    {"MapSamples", &samples_}}),
                          shared::MapDepthParams{bins_.grid, first + s, spp_, seed_, s * texels}, groups_of(texels, 64));
    }
    recorder.submit();
}

std::vector<gpu::Binding> TimeDependentMap::read_bindings() const {
    return {{"map_samples", &samples_, motion_ ? Texel::rg32_float : Texel::r32_float}};
}

std::vector<uint32_t> TimeDependentMap::test_constants() const {
    return {std::bit_cast<uint32_t>(map_bias(light_)), motion_ ? 1u : 0u, seed_};
}

}  // namespace gnomon
