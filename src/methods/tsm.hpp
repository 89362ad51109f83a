// SPDX-License-Identifier: Apache-2.0
// Time-dependent shadow maps: N depths per texel, one in each stratum of the shutter.
// Based on: Akenine-Moller et al. 2007, "Stochastic rasterization using time-continuous triangles", section 5.
#pragma once

#include "methods/method.hpp"
#include "stages/trace.hpp"

namespace gnomon {

/// Parameters map-spp and bias, as options.
std::vector<Parameter> tsm_parameters();

/// Samples per texel: map-spp, else the camera's.
uint32_t map_spp(const LightContext& light);

/// Metres: bias, else twice a texel's width; of a spot's, at a distance of the diagonal of the scene's bounds.
float map_bias(const LightContext& light);

/// The seed of a light's map, so that it is sampled at other places and times than the camera's image.
uint32_t map_seed(const LightContext& light);

class TimeDependentMap final : public ShadowMap {
public:
    /// motion: samples hold how far their surface moves along the light's axis (Andersson et al. 2015, section 5.1).
    TimeDependentMap(const LightContext& light, const Bins& bins, bool motion);

    ItemOrder order() const override { return {spp_, 1, tile_count_}; }
    uint32_t item_count() const override { return spp_ * tile_count_; }
    std::map<std::string, uint64_t> counts() const override;
    std::map<std::string, std::string> effective() const override;
    std::vector<Band> bands(uint64_t bytes) const override;
    void fill(const Band& band) override;
    std::vector<gpu::Binding> read_bindings() const override;
    uint32_t range_base() const override { return base_; }
    std::vector<uint32_t> test_constants() const override;

private:
    uint64_t sample_bytes() const { return motion_ ? 8 : 4; }

    const LightContext& light_;
    const Bins& bins_;
    bool motion_;
    uint32_t spp_, seed_, tile_count_;
    uint32_t base_ = 0;
    Tracer tracer_;
    gpu::Buffer samples_;
};

}  // namespace gnomon
