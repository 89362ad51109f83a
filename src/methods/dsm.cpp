// SPDX-License-Identifier: Apache-2.0
#include "methods/dsm.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>

#include "math/sample.h"
#include "stages/grid.hpp"
#include "stages/scan.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

// Bytes of the samples that are clustered at one time.
constexpr uint64_t kBatchBytes = 32ull << 20;

class DeepShadowMap final : public ShadowMap {
public:
    DeepShadowMap(const LightContext& light, const Bins& bins);

    ItemOrder order() const override { return {}; }
    uint32_t item_count() const override { return tile_count_; }
    uint64_t longest() const override { return sampling_.spp; }
    std::vector<Band> bands(uint64_t /*bytes*/) const override { return {{0, tile_count_, 0, cluster_count_}}; }
    void fill(const Band& /*band*/) override {}
    std::map<std::string, uint64_t> counts() const override {
        return {{"map_samples", uint64_t(tile_count_) * shared::kTileTexels * sampling_.spp},
                {"clusters", cluster_count_},
                {"map_bytes", offsets_.bytes() + cluster_count_ * sizeof(glm::vec2)}};
    }
    std::map<std::string, std::string> effective() const override {
        std::map<std::string, std::string> all = map_effective(light_, sampling_, map_bias(light_));
        all.insert(dsm_extent(light_).effective("cluster"));
        return all;
    }
    std::vector<gpu::Binding> read_bindings() const override {
        return {{"offsets", &offsets_, Texel::r32_uint}, {"clusters", &clusters_, Texel::rg32_float}};
    }
    std::vector<uint32_t> test_constants() const override { return map_bias(light_).constants(); }

private:
    struct Piece {
        gpu::Buffer clusters;
        uint32_t count = 0;
    };
    Piece make_clusters(Tracer& tracer, const gpu::Buffer& samples, uint32_t tile_first, uint32_t tile_count);

    const LightContext& light_;
    const Bins& bins_;
    Sampling sampling_;
    uint32_t tile_count_;
    uint64_t cluster_count_ = 0;
    gpu::Buffer offsets_, clusters_;
    Unbound unbound_;
};

DeepShadowMap::DeepShadowMap(const LightContext& light, const Bins& bins)
    : light_(light),
      bins_(bins),
      sampling_(dsm_sampling(light)),
      tile_count_(bins.window.tile_count),
      unbound_(light.device, 3) {
    gpu::Device& device = light.device;
    const uint64_t texels = uint64_t(tile_count_) * shared::kTileTexels;
    if ((texels + 1) * 4 > std::min(device.limits().max_storage_range, device.limits().most_elements(4) * 4)) {
        throw Error(ErrorKind::out_of_memory,
                    std::to_string(texels) + " texels of a light's map are more than the device can bind", "shadow map",
                    "use a smaller --shadow-res");
    }
    offsets_ = device.allocate("map_offsets", (texels + 1) * 4);
    const uint64_t tile_bytes = uint64_t(sampling_.spp) * shared::kTileTexels * 4;
    const uint64_t batch_bytes =
        std::min({kBatchBytes, device.limits().max_storage_range, device.limits().most_elements(4) * 4});
    const auto step = static_cast<uint32_t>(std::clamp<uint64_t>(batch_bytes / tile_bytes, 1, tile_count_));
    std::vector<Piece> pieces;
    {
        Tracer tracer(device, light.programs, light.geometry, light.view, bins, "map/trace", sampling_,
                      uint64_t(step) * sampling_.spp * shared::kTileTexels);
        const gpu::Buffer samples = device.allocate("map_samples", step * tile_bytes);
        for (uint32_t tile = 0; tile < tile_count_; tile += step)
            pieces.push_back(make_clusters(tracer, samples, tile, std::min(step, tile_count_ - tile)));
    }
    if (cluster_count_ > std::min<uint64_t>(device.limits().most_elements(8), 0xffffffffull)) {
        throw Error(ErrorKind::out_of_memory, std::to_string(cluster_count_) + " clusters in a light's map", "shadow map",
                    "use a smaller --shadow-res or a larger --cluster");
    }
    clusters_ = device.allocate("clusters", cluster_count_ * sizeof(glm::vec2));
    gpu::Recorder& recorder = device.recorder();
    uint64_t at = 0;
    for (const Piece& piece : pieces) {
        const uint64_t bytes = piece.count * sizeof(glm::vec2);
        if (bytes > 0) recorder.copy("map/cluster", piece.clusters, 0, clusters_, at, bytes);
        at += bytes;
    }
    recorder.fill("map/cluster", offsets_, static_cast<uint32_t>(cluster_count_), texels * 4, 4);
}

// The clusters of some of the window's tiles, and their texels' offsets.
DeepShadowMap::Piece DeepShadowMap::make_clusters(Tracer& tracer, const gpu::Buffer& samples, uint32_t tile_first,
                                                  uint32_t tile_count) {
    gpu::Device& device = light_.device;
    const Batch batch{bins_.window.tile_first + tile_first, tile_count, 0, sampling_.spp};
    const uint32_t texels = tile_count * shared::kTileTexels;
    const AxisLength extent = dsm_extent(light_);
    const gpu::Buffer counts = device.allocate("cluster_counts", scan_bytes(texels));
    const gpu::Buffer sums = device.allocate("cluster_sums", scan_bytes(texels));
    const shared::ClusterParams params{
        tile_count,    sampling_.spp,   tile_first * shared::kTileTexels, static_cast<uint32_t>(cluster_count_),
        extent.metres, extent.per_metre};
    const auto record = [&](gpu::Recorder& recorder, bool fill, std::initializer_list<gpu::Binding> own) {
        std::vector<gpu::Binding> all = own;
        all.push_back({"map_samples", &samples, Texel::r32_float});
        recorder.dispatch("map/cluster", light_.programs.get("methods/dsm/cluster", {fill}), all, params,
                          groups_of(texels, 64));
    };
    gpu::Recorder& recorder = device.recorder();
    record_depths(recorder, light_, bins_, tracer, sampling_, 1, batch, samples, 0);
    recorder.fill("map/cluster", counts, 0);
    record(recorder, false,
           {{"Counts", &counts},
            unbound_.at(0, "scanned", Texel::r32_uint),
            unbound_.at(1, "Clusters"),
            unbound_.at(2, "Offsets")});
    record_scan(device, light_.programs, counts, texels, sums);
    const uint32_t found = gpu::download_vector<uint32_t>(device, sums, 1, uint64_t(texels) * 4)[0];
    gpu::Buffer clusters = device.allocate("cluster_pieces", found * sizeof(glm::vec2));
    record(recorder, true,
           {unbound_.at(0, "Counts"), {"scanned", &sums, Texel::r32_uint}, {"Clusters", &clusters}, {"Offsets", &offsets_}});
    cluster_count_ += found;
    return {std::move(clusters), found};
}

}  // namespace

std::vector<Parameter> dsm_parameters() {
    std::vector<Parameter> parameters = depth_map_parameters(DepthMapKind::stochastic);
    parameters[0] = {"map-spp", "samples", "Samples per texel of the map, at random times", "128", 1, 176, true};
    parameters.push_back({"cluster", "metres", "Along the light's axis; samples that lie together within it are one occluder",
                          "half the bias", 0, 1e6});
    return parameters;
}

Sampling dsm_sampling(const LightContext& light) {
    return {static_cast<uint32_t>(light.parameter("map-spp").value_or(128)),
            shared::light_seed(light.settings.seed, light.light_ix)};
}

AxisLength dsm_extent(const LightContext& light) {
    if (const std::optional<double> metres = light.parameter("cluster")) return {static_cast<float>(*metres)};
    const AxisLength bias = map_bias(light).length(light.view);
    return {0.5f * bias.metres, 0.5f * bias.per_metre};
}

std::unique_ptr<ShadowMap> make_deep_shadow_map(const LightContext& light, const Bins& bins) {
    return std::make_unique<DeepShadowMap>(light, bins);
}

}  // namespace gnomon
