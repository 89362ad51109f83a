// SPDX-License-Identifier: Apache-2.0
#include "methods/ranges.hpp"

#include <gnomon/error.hpp>

#include "methods/depth_map.hpp"
#include "stages/coverage.hpp"
#include "stages/prism.hpp"

namespace gnomon {
namespace {

constexpr const char* kCullBackFaces = "cull-back-faces";

bool culls_back_faces(const LightContext& light) { return light.parameter(kCullBackFaces).value_or(0) != 0; }

SBuffer s_buffer_of(const LightContext& light, const Bins& bins, const gpu::Buffer* coverage) {
    const std::string shader = light.layout.stage("raster/" + light.raster);
    const bool orthographic = light.view.orthographic;
    const RasterSource source{light.geometry, bins, light.asked};
    if (light.layout.lists_triangles() && light.raster != "conservative") {
        throw Error(ErrorKind::usage, "raster '" + light.raster + "' does not number the triangles of a tile", "--layout",
                    "use another layout than '" + light.layout.name + "', or --raster conservative");
    }
    if (light.raster != "prism") {
        return {light.device, light.programs, walk_bins(light.programs, source, shader, orthographic), light.layout,
                light.watch};
    }
    // A quarter for the fragments: what the ranges take is bounded on its own, by the bands that are filled.
    constexpr uint64_t kShare = 4;
    try {
        return {light.device, light.programs,
                pair_fragments(light.device, light.programs, source, shader, {orthographic, culls_back_faces(light), coverage},
                               light.bytes / kShare),
                light.layout, light.watch};
    } catch (const BandTooLarge& error) {
        throw BandTooLarge(error, kShare);
    }
}

class RangeMap final : public ShadowMap {
public:
    RangeMap(const LightContext& light, const Bins& bins, bool covered)
        : coverage_(covered ? make_coverage(light.device, light.programs, {light.geometry, bins, light.asked},
                                            light.view.orthographic, culls_back_faces(light))
                            : CoverageMap()),
          ranges_(s_buffer_of(light, bins, covered ? &coverage_.coverage : nullptr)),
          bias_(map_bias(light)),
          bias_length_(bias_.length(light.view)) {}

    ItemOrder order() const override { return ranges_.order(); }
    uint32_t item_count() const override { return ranges_.item_count(); }
    uint64_t longest() const override { return ranges_.longest(); }
    std::vector<Band> bands(uint64_t bytes) const override { return ranges_.bands(bytes); }
    void fill(const Band& band) override { ranges_.fill(band); }
    const SBuffer* s_buffer() const override { return &ranges_; }
    std::map<std::string, uint64_t> counts() const override {
        std::map<std::string, uint64_t> counts = ranges_.counts();
        if (coverage_.coverage) {
            counts["covered_texels"] = coverage_.covered;
            counts["map_bytes"] += coverage_.bytes();
        }
        return counts;
    }
    std::map<std::string, std::string> effective() const override { return {bias_length_.effective("bias")}; }
    std::vector<gpu::Binding> read_bindings() const override {
        std::vector<gpu::Binding> all = ranges_.read_bindings();
        if (coverage_.coverage) all.push_back({"coverage", &coverage_.coverage, gpu::Texel::r32_uint});
        return all;
    }
    std::vector<uint32_t> test_constants() const override { return bias_.constants(); }

private:
    CoverageMap coverage_;
    SBuffer ranges_;
    Bias bias_;
    AxisLength bias_length_;
};

void check_culling(const LightContext& light) {
    if (light.parameter(kCullBackFaces) && light.raster != "prism") {
        throw Error(ErrorKind::usage, "raster '" + light.raster + "' keeps all prisms", "--cull-back-faces",
                    "leave it out or use --raster prism");
    }
}

}  // namespace

std::vector<Parameter> dtr_parameters(bool prisms) {
    std::vector<Parameter> parameters = {bias_parameter()};
    if (prisms) {
        parameters.push_back({kCullBackFaces, "0 or 1",
                              "Leave out triangles that the light sees from behind at both ends of their motion", "0", 0, 1,
                              true});
    }
    return parameters;
}

std::unique_ptr<ShadowMap> make_s_buffer(const LightContext& light, const Bins& bins) {
    return std::unique_ptr<SBuffer>(new SBuffer(s_buffer_of(light, bins, nullptr)));
}

std::unique_ptr<ShadowMap> make_dtr_map(const LightContext& light, const Bins& bins) {
    check_culling(light);
    return std::make_unique<RangeMap>(light, bins, false);
}

std::unique_ptr<ShadowMap> make_temporal_map(const LightContext& light, const Bins& bins) {
    return std::make_unique<RangeMap>(light, bins, true);
}

}  // namespace gnomon
