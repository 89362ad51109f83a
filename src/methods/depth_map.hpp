// SPDX-License-Identifier: Apache-2.0
// Maps of N depths per texel, one in each stratum of the shutter: time-dependent shadow maps, whose texels are sampled anywhere
// and anytime in their stratum, and the accumulation buffer's hard shadow maps, each of one time.
// Sources: Akenine-Moller et al. 2007, section 5; Andersson et al. 2015, section 5.1; Haeberli and Akeley 1990.
#pragma once

#include "methods/method.hpp"
#include "stages/trace.hpp"

namespace gnomon {

enum class DepthMapKind {
    stochastic,    ///< tsm
    dynamic_bias,  ///< Samples also hold how far their surface moves along the light's axis.
    slices,        ///< accumulate
};

/// A length along a light's axis, at a depth of so many metres: metres + per_metre * depth.
struct AxisLength {
    float metres = 0.0f;
    float per_metre = 0.0f;

    /// The one that is not 0, as `name` or `name`_per_metre.
    std::pair<std::string, std::string> effective(const std::string& name) const;
};

/// What is subtracted from a hit's depth (common/bias.glsl): metres and texels' widths.
struct Bias {
    float metres = 0.0f;
    float texels = 0.0f;

    std::vector<uint32_t> constants() const;  ///< Both, as shaders take them.
    AxisLength length(const View& light) const;
};

/// The bias of all methods that compare depths.
Parameter bias_parameter();

/// map-spp or slices, and bias.
std::vector<Parameter> depth_map_parameters(DepthMapKind kind);

/// How the light's view is sampled: map-spp or slices, else as often as the camera's image or 3000 times; with a seed of the
/// light's own.
Sampling map_sampling(const LightContext& light, DepthMapKind kind);

/// The parameter bias, else so many texels.
Bias map_bias(const LightContext& light, double texels = 2.0);

/// map_spp (slices) and bias, as they are used.
std::map<std::string, std::string> map_effective(const LightContext& light, const Sampling& sampling, const Bias& bias);

/// Trace a batch of a light's samples and write them to elements [first, ...) of `samples`, of so many floats: 1, the depth; 2,
/// with the motion along the axis; 4, with the motion in x and y before it.
void record_depths(gpu::Recorder& recorder, const LightContext& light, const Bins& bins, Tracer& tracer,
                   const Sampling& sampling, uint32_t floats, const Batch& batch, const gpu::Buffer& samples, uint64_t first);

class DepthMap final : public ShadowMap {
public:
    DepthMap(const LightContext& light, const Bins& bins, DepthMapKind kind);

    ItemOrder order() const override { return {sampling_.spp, true}; }
    uint32_t item_count() const override { return sampling_.spp * tile_count_; }
    std::map<std::string, uint64_t> counts() const override;
    std::map<std::string, std::string> effective() const override { return map_effective(light_, sampling_, map_bias(light_)); }
    std::vector<Band> bands(uint64_t bytes) const override;
    void fill(const Band& band) override;
    std::vector<gpu::Binding> read_bindings() const override;
    uint32_t range_base() const override { return base_; }
    std::vector<uint32_t> test_constants() const override;

private:
    bool motion() const { return kind_ == DepthMapKind::dynamic_bias; }
    uint32_t sample_floats() const { return motion() ? 2 : 1; }
    uint64_t sample_bytes() const { return sample_floats() * sizeof(float); }

    const LightContext& light_;
    const Bins& bins_;
    DepthMapKind kind_;
    Sampling sampling_;
    uint32_t tile_count_;
    uint32_t base_ = 0;
    Tracer tracer_;
    gpu::Buffer samples_;
};

}  // namespace gnomon
