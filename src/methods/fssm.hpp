// SPDX-License-Identifier: Apache-2.0
// Filtered stochastic shadow maps: tiles of a stochastic light map as a few layers of depth, each moved along its mean motion
// to the middle of the shutter and kept as variance shadow map. Based on: Andersson et al. 2015, "Filtered stochastic shadow
// mapping using a layered approach", sections 4 and 5.
#pragma once

#include "methods/depth_map.hpp"

namespace gnomon {

/// Those of tsm, and one for each part of the method.
std::vector<Parameter> fssm_parameters();

class Fssm final : public ShadowMap {
public:
    /// Errors: ErrorKind::usage for a tile that is neither 4 nor 8.
    Fssm(const LightContext& light, const Bins& bins);

    ItemOrder order() const override { return {}; }
    uint32_t item_count() const override { return bins_.window.tile_count; }
    std::map<std::string, uint64_t> counts() const override;
    std::map<std::string, std::string> effective() const override;
    /// Rows of tiles; with each the rows beside it, to which lookups near its border may go. What a band takes includes its
    /// samples, which are made in parts and are gone when it is filled.
    std::vector<Band> bands(uint64_t bytes) const override;
    void fill(const Band& band) override;
    std::vector<gpu::Binding> read_bindings() const override;
    uint32_t range_base() const override { return base_; }  ///< The first tile in memory.
    std::vector<uint32_t> test_constants() const override;

    /// Texels along the side of a tile, of the window around it and of a layer's grid (sections 5 and 6).
    struct Sizes {
        uint32_t tile, window, grid;
    };

private:
    struct Rows {
        uint32_t first = 0;  ///< Of the method's tiles.
        uint32_t count = 0;
    };
    uint64_t layer_bytes() const;                        ///< Of one layer of one tile.
    uint64_t row_bytes() const;                          ///< Of a row of the method's tiles.
    uint64_t window_texels(uint32_t row_count) const;    ///< That so many rows need, at most.
    uint32_t rows_at_once(uint32_t row_count) const;     ///< Rows of a band whose samples are made together.
    Rows rows_of(uint32_t first, uint32_t count) const;  ///< In memory for a band of rows of 8 x 8 texels.
    void fill_rows(gpu::Recorder& recorder, Tracer& tracer, const Rows& rows, const Rows& band);
    void record_mips(gpu::Recorder& recorder, uint32_t layer_first, uint32_t layer_count);
    /// The tuples of some layers in a level.
    struct Tuples {
        uint64_t offset = 0;  ///< Of their binding, in bytes.
        uint64_t bytes = 0;
        uint32_t first = 0;  ///< Where the first layer's are in the binding.
        gpu::Binding binding(const Fssm& map, std::string_view name) const {
            return {name, &map.tuples_, gpu::Texel::rgba32_float, offset, bytes};
        }
    };
    Tuples tuples_in(uint32_t level, uint32_t layer_first, uint32_t layer_count) const;

    const LightContext& light_;
    const Bins& bins_;
    Sampling sampling_;
    Bias bias_;
    Sizes sizes_;
    uint32_t layer_count_, level_count_, tuple_count_;
    uint32_t tiles_x_, tiles_y_;  ///< The method's tiles.
    uint32_t rows_;               ///< Of tiles of 8 x 8 texels.
    bool views_move_ = false;
    uint32_t base_ = 0;
    std::vector<uint32_t> level_first_;  ///< Of the band in memory, in tuples.
    gpu::Buffer views_, samples_, layers_, tuples_;
};

}  // namespace gnomon
