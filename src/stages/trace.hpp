// SPDX-License-Identifier: Apache-2.0
// The nearest triangle at each sample of a view, a batch of samples at a time. The same code serves camera and lights.
#pragma once

#include "stages/bin.hpp"

namespace gnomon {

/// A rectangle of work: tiles [tile_first, tile_first + tile_count) and strata [stratum_first, ...) of each of their pixels.
struct Batch {
    uint32_t tile_first = 0;
    uint32_t tile_count = 0;
    uint32_t stratum_first = 0;
    uint32_t stratum_count = 0;

    uint64_t slot_count() const { return uint64_t(tile_count) * stratum_count * shared::kTileTexels; }
};

/// Which sample lies at a slot of a batch.
struct SlotSample {
    uint32_t x = 0;  ///< Pixel; may lie beyond the image's edge, in the tile.
    uint32_t y = 0;
    uint32_t stratum = 0;
};
SlotSample slot_sample(const Batch& batch, const shared::ViewGrid& grid, uint64_t slot);

/// Where and when the pixels of a view are sampled (comp_shaders/math/sample.h).
struct Sampling {
    uint32_t spp = 1;  ///< Samples of a pixel, one in each stratum of time.
    uint32_t seed = 0;
    bool sliced = false;  ///< All pixels in their centres at the same times: slice_point.
    bool count_tests = false;
};

class Tracer {
public:
    /// stage: the name among the timings. most_slots: of a batch.
    Tracer(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Bins& bins,
           std::string stage, const Sampling& sampling, uint64_t most_slots);

    void record(gpu::Recorder& recorder, const Batch& batch);

    /// Per slot of the batch: the nearest triangle, with kReversed where its orientation is reversed, or kNone.
    const gpu::Buffer& hits() const { return hits_; }
    /// 64 bits: samples times triangles that were tested so far, whole tiles, where Sampling::count_tests.
    const gpu::Buffer& test_count() const { return test_count_; }
    /// A stratum may lie in several cells of time.
    bool straddle() const { return straddle_; }

private:
    void record(gpu::Recorder& recorder, const Batch& batch, uint32_t cell_turn, uint32_t list_first);

    Programs& programs_;
    const Geometry& geometry_;
    const View& view_;
    const Bins& bins_;
    std::string stage_;
    Sampling sampling_;
    bool straddle_;
    uint32_t cell_turns_;  ///< Dispatches in which the cells of each stratum are walked, one after the other.
    gpu::Buffer hits_, test_count_;
};

}  // namespace gnomon
