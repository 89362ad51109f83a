// SPDX-License-Identifier: Apache-2.0
#include "methods/ranges.hpp"

#include <gnomon/error.hpp>

#include "stages/coverage.hpp"
#include "stages/prism.hpp"

namespace gnomon {
namespace {

constexpr const char* kCullBackFaces = "cull-back-faces";

bool culls_back_faces(const LightContext& light) { return light.parameter(kCullBackFaces).value_or(0) != 0; }

SBuffer s_buffer(const LightContext& light, const Bins& bins, const gpu::Buffer* coverage) {
    const std::string shader = light.layout.stage("raster/" + light.raster);
    const bool orthographic = light.view.orthographic;
    if (light.raster != "prism") {
        return {light.device, light.programs, walk_bins(light.programs, light.geometry, bins, shader, orthographic),
                light.layout};
    }
    // A quarter for the fragments: what the ranges take is bounded on its own, by the bands that are filled.
    return {light.device, light.programs,
            pair_fragments(light.device, light.programs, light.geometry, bins, shader,
                           {orthographic, culls_back_faces(light), coverage}, light.bytes / 4),
            light.layout};
}

class TemporalMap final : public ShadowMap {
public:
    TemporalMap(const LightContext& light, const Bins& bins)
        : coverage_(make_coverage(light.device, light.programs, light.geometry, bins, light.view.orthographic,
                                  culls_back_faces(light))),
          ranges_(s_buffer(light, bins, &coverage_.coverage)) {}

    ItemOrder order() const override { return ranges_.order(); }
    uint32_t item_count() const override { return ranges_.item_count(); }
    uint64_t longest() const override { return ranges_.longest(); }
    std::vector<Band> bands(uint64_t bytes) const override { return ranges_.bands(bytes); }
    void fill(const Band& band) override { ranges_.fill(band); }
    uint32_t range_base() const override { return ranges_.range_base(); }
    std::map<std::string, uint64_t> counts() const override {
        std::map<std::string, uint64_t> counts = ranges_.counts();
        counts["covered_texels"] = coverage_.covered;
        counts["map_bytes"] += coverage_.bytes();
        return counts;
    }
    std::vector<gpu::Binding> read_bindings() const override {
        std::vector<gpu::Binding> all = ranges_.read_bindings();
        all.push_back({"coverage", &coverage_.coverage, gpu::Texel::r32_uint});
        return all;
    }

private:
    CoverageMap coverage_;
    SBuffer ranges_;
};

}  // namespace

std::vector<Parameter> prism_parameters() {
    return {{kCullBackFaces, "0 or 1", "Leave out triangles that the light sees from behind at both ends of their motion", "0",
             0, 1, true}};
}

std::unique_ptr<ShadowMap> make_s_buffer(const LightContext& light, const Bins& bins) {
    if (light.parameter(kCullBackFaces) && light.raster != "prism") {
        throw Error(ErrorKind::usage, "raster '" + light.raster + "' keeps all prisms", "--cull-back-faces",
                    "leave it out or use --raster prism");
    }
    return std::unique_ptr<SBuffer>(new SBuffer(s_buffer(light, bins, nullptr)));
}

std::unique_ptr<ShadowMap> make_temporal_map(const LightContext& light, const Bins& bins) {
    return std::make_unique<TemporalMap>(light, bins);
}

}  // namespace gnomon
