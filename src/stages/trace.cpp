// SPDX-License-Identifier: Apache-2.0
#include "stages/trace.hpp"

#include "math/sample.h"
#include "shared/slot.h"
#include "stages/grid.hpp"

namespace gnomon {

using gpu::Texel;

SlotSample slot_sample(const Batch& batch, const shared::ViewGrid& grid, uint64_t slot) {
    const auto item = static_cast<uint32_t>(slot / shared::kTileTexels),
               place = static_cast<uint32_t>(slot % shared::kTileTexels);
    const uint32_t tile = batch.tile_first + item / batch.stratum_count;
    return {tile % grid.tiles_x * shared::kTileSize + shared::slot_column(place),
            tile / grid.tiles_x * shared::kTileSize + shared::slot_row(place),
            batch.stratum_first + item % batch.stratum_count};
}

namespace {

uint32_t most_cells_of_a_stratum(uint32_t spp, uint32_t cells) {
    const float length = shared::stratum_length(spp);
    uint32_t most = 0;
    for (uint32_t s = 0; s < spp; ++s) {
        const uint32_t first = shared::cell_of(shared::stratum_start(s, length), cells);
        const uint32_t last = shared::cell_of(shared::stratum_start(s + 1, length), cells);
        most = std::max(most, last - first + 1);
    }
    return most;
}

}  // namespace

Tracer::Tracer(gpu::Device& device, Programs& programs, const Geometry& geometry, const View& view, const Bins& bins,
               std::string stage, const Sampling& sampling, uint64_t most_slots)
    : programs_(programs),
      geometry_(geometry),
      view_(view),
      bins_(bins),
      stage_(std::move(stage)),
      sampling_(sampling),
      straddle_(sampling.spp % bins.grid.cell_count != 0),
      cell_turns_(straddle_ ? most_cells_of_a_stratum(sampling.spp, bins.grid.cell_count) : 1),
      hits_(device.allocate("hits", most_slots * 4)),
      test_count_(gpu::upload_new(device, "test_count", std::vector<uint32_t>(2))) {}

void Tracer::record(gpu::Recorder& recorder, const Batch& batch) {
    for (uint32_t turn = 0; turn < cell_turns_; ++turn) {
        for (uint32_t first = 0; first == 0 || first < bins_.longest; first += shared::kListChunk)
            record(recorder, batch, turn, first);
    }
}

void Tracer::record(gpu::Recorder& recorder, const Batch& batch, uint32_t cell_turn, uint32_t list_first) {
    recorder.dispatch(
        stage_,
        programs_.get("sample/trace", {view_.orthographic, straddle_, list_first > 0, sampling_.sliced, programs_.crew(),
                                       bins_.part == Part::apart, bins_.facing_first, sampling_.count_tests}),
        bindings({{"bin_offsets", &bins_.offsets, Texel::r32_uint},
                  {"bin_entries", &bins_.entries, Texel::r32_uint},
                  {"triangles", &geometry_.scene->triangles, Texel::rgba32_uint},
                  {"raster_vertices", &bins_.raster_vertices, Texel::rgba32_float},
                  {"Hits", &hits_},
                  {"TestCount", &test_count_}}),
        shared::TraceParams{bins_.grid, batch.tile_first, batch.tile_count, batch.stratum_first, batch.stratum_count,
                            sampling_.spp, shared::stratum_length(sampling_.spp), sampling_.seed, list_first, cell_turn,
                            view_.depth_near, view_.depth_far},
        groups_of(uint64_t(batch.tile_count) * batch.stratum_count, 8));
}

}  // namespace gnomon
