// SPDX-License-Identifier: Apache-2.0
#include "stages/prism.hpp"

#include "layouts/sources.hpp"
#include "math/prism.h"
#include "stages/grid.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

// The linked list of fragments.
Layout fragment_layout() {
    constexpr const char* kManifest = "raster/fragments/layout.json";
    return parse_layout(*find_source(kManifest), kManifest);
}

class CollectFragments final : public RasterStage {
public:
    CollectFragments(gpu::Device& device, Programs& programs, const RasterSource& source, const PrismSettings& settings)
        : programs_(programs), source_(source), settings_(settings), no_coverage_(device.allocate("unbound", 4)) {}

    const shared::ViewGrid& grid() const override { return source_.bins.grid; }
    uint32_t item_count() const override { return source_.item_count(); }
    uint32_t items_per_group() const override { return 8; }
    uint64_t longest() const override { return uint64_t(source_.longest()) * shared::kPrismTriangles; }
    uint32_t part_count() const override { return source_.part_count(); }
    bool keeps_list_state() const override { return false; }
    const char* timing(bool fill) const override { return fill ? "raster/fragments" : "raster/count_fragments"; }
    const gpu::Program& program(bool fill) const override {
        return programs_.get("raster/fragments", {fill, settings_.orthographic, settings_.cull_back_faces,
                                                  source_.asked != nullptr, settings_.coverage != nullptr});
    }
    std::vector<gpu::Binding> bindings() const override {
        std::vector<gpu::Binding> all = source_.bindings();
        all.push_back({"coverage", settings_.coverage != nullptr ? settings_.coverage : &no_coverage_, Texel::r32_uint});
        return all;
    }

private:
    Programs& programs_;
    RasterSource source_;
    PrismSettings settings_;
    gpu::Buffer no_coverage_;
};

class PairFragments final : public RasterStage {
public:
    PairFragments(gpu::Device& device, Programs& programs, const RasterSource& source, std::string shader,
                  const PrismSettings& settings, uint64_t bytes)
        : device_(device),
          programs_(programs),
          source_(source),
          shader_(std::move(shader)),
          fragments_(device, programs, std::make_unique<CollectFragments>(device, programs, source, settings),
                     fragment_layout()),
          portions_(fragments_.bands(bytes)) {
        const uint64_t blocks = groups_of(fragments_.item_count(), shared::kCountBlock);
        pair_counts_ = gpu::upload_new(device, "pair_counts", std::vector<glm::uvec2>(blocks));
        const uint64_t resumed = std::min(fragments_.list_count() * 4, device.limits().max_storage_range);
        resume_ = device.allocate("resume", part_count() > 1 ? resumed : 4);
    }

    const shared::ViewGrid& grid() const override { return fragments_.grid(); }
    uint32_t item_count() const override { return fragments_.item_count(); }
    uint32_t items_per_group() const override { return 1; }
    uint64_t longest() const override { return fragments_.longest() / 2; }
    uint32_t part_count() const override {
        return std::max(1u, static_cast<uint32_t>(groups_of(fragments_.longest(), shared::kPairChunk)));
    }
    const gpu::Program& program(bool fill) const override {
        return programs_.get(shader_, {fill, part_count() > 1, source_.asked != nullptr});
    }
    std::vector<gpu::Binding> bindings() const override {
        std::vector<gpu::Binding> all = fragments_.read_bindings();
        all.push_back({"PairCounts", &pair_counts_});
        all.push_back({"Resume", &resume_});
        all.push_back(source_.pages());
        return all;
    }
    std::map<std::string, uint64_t> counts() const override {
        std::map<std::string, uint64_t> counts = {
            {"fragments", fragments_.range_count()}, {"fragments_left_over", 0}, {"prisms_of_more_than_4_fragments", 0}};
        const uint64_t blocks = pair_counts_.bytes() / sizeof(glm::uvec2);
        for (const glm::uvec2& block : gpu::download_vector<glm::uvec2>(device_, pair_counts_, blocks)) {
            counts["fragments_left_over"] += block.x;
            counts["prisms_of_more_than_4_fragments"] += block.y;
        }
        return counts;
    }
    uint64_t source_bytes() const override { return fragments_.map_bytes(); }

    std::vector<Band> portions() const override { return portions_; }
    void prepare(const Band& portion) override {
        fragments_.fill(portion);
        fragment_item_ = portion.item_first;
    }
    uint32_t fragment_item() const override { return fragment_item_; }

private:
    gpu::Device& device_;
    Programs& programs_;
    RasterSource source_;
    std::string shader_;
    SBuffer fragments_;
    std::vector<Band> portions_;
    uint32_t fragment_item_ = 0;  // The first of the portion.
    gpu::Buffer pair_counts_, resume_;
};

}  // namespace

std::unique_ptr<RasterStage> pair_fragments(gpu::Device& device, Programs& programs, const RasterSource& source,
                                            const std::string& shader, const PrismSettings& settings, uint64_t bytes) {
    return std::make_unique<PairFragments>(device, programs, source, shader, settings, bytes);
}

}  // namespace gnomon
