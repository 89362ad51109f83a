// SPDX-License-Identifier: Apache-2.0
#include "stages/raster_stage.hpp"

#include <gnomon/error.hpp>

#include "stages/grid.hpp"

namespace gnomon {
namespace {

using gpu::Texel;

class WalkBins final : public RasterStage {
public:
    WalkBins(Programs& programs, const RasterSource& source, std::string shader, std::vector<uint32_t> constants,
             uint32_t items_per_group, uint32_t ranges_per_prism)
        : programs_(programs),
          source_(source),
          shader_(std::move(shader)),
          constants_(std::move(constants)),
          items_per_group_(items_per_group),
          ranges_per_prism_(ranges_per_prism) {}

    const shared::ViewGrid& grid() const override { return source_.bins.grid; }
    uint32_t item_count() const override { return source_.item_count(); }
    uint32_t items_per_group() const override { return items_per_group_; }
    uint64_t longest() const override { return uint64_t(source_.longest()) * ranges_per_prism_; }
    uint32_t part_count() const override { return source_.part_count(); }
    uint32_t entry_first() const override { return source_.entry_first(); }
    const gpu::Program& program(bool fill) const override {
        std::vector<uint32_t> all = {fill};
        all.insert(all.end(), constants_.begin(), constants_.end());
        all.push_back(source_.asked != nullptr);
        all.push_back(part_count() > 1);
        return programs_.get(shader_, all);
    }
    std::vector<gpu::Binding> bindings() const override { return source_.bindings(); }
    bool asked() const override { return source_.asked != nullptr; }

private:
    Programs& programs_;
    RasterSource source_;
    std::string shader_;
    std::vector<uint32_t> constants_;  // Behind the pass.
    uint32_t items_per_group_;
    uint32_t ranges_per_prism_;
};

}  // namespace

gpu::Binding RasterSource::pages() const {
    // Any buffer that holds an element, where none are asked for.
    return {"pages", asked != nullptr ? &asked->pages() : &geometry.scene->triangles, Texel::rgba32_uint};
}

std::vector<gpu::Binding> RasterSource::bindings() const {
    return gnomon::bindings({{"bin_offsets", &bins.offsets, Texel::r32_uint},
                             {"bin_entries", &bins.entries, Texel::r32_uint},
                             {"triangles", &geometry.scene->triangles, Texel::rgba32_uint},
                             {"raster_vertices", &bins.raster_vertices, Texel::rgba32_float},
                             {"page_entries", asked != nullptr ? &asked->entries() : &bins.entries, Texel::r32_uint},
                             pages()});
}

uint32_t RasterSource::part_count() const {
    return std::max(1u, static_cast<uint32_t>(groups_of(longest(), shared::kListChunk)));
}

std::unique_ptr<RasterStage> walk_bins(Programs& programs, const RasterSource& source, const std::string& shader,
                                       bool orthographic) {
    const std::string stage = shader.substr(0, shader.find('@'));
    using Constants = std::vector<uint32_t>;
    if (stage == "raster/conservative") {
        return std::make_unique<WalkBins>(programs, source, shader, Constants{orthographic, programs.crew()}, 8, 1);
    }
    if (stage == "raster/analytic") return std::make_unique<WalkBins>(programs, source, shader, Constants{orthographic}, 1, 4);
    throw Error(ErrorKind::internal, "no such raster stage", shader, "report this as a bug");
}

}  // namespace gnomon
