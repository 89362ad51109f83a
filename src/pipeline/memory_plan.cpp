// SPDX-License-Identifier: Apache-2.0
#include "pipeline/memory_plan.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

namespace gnomon {
namespace {

// More cells cut the tests of fast prisms and list slow ones again in each.
constexpr uint32_t kFewestCells = 8;
constexpr uint32_t kMostCells = 16;
constexpr uint32_t kLightCells = 4;
// Enough samples to keep any device busy; the buffers of a batch stay small.
constexpr uint64_t kBatchSlots = 4u << 20;
// A loop over a batch's strata must end before lavapipe's limit of iterations, with all its lights.
constexpr uint32_t kMostStrata = 1024;
constexpr uint64_t kSlotBytes = 16;

bool same(const Rigid& a, const Rigid& b) { return a.translation == b.translation && a.rotation == b.rotation; }

}  // namespace

bool is_still(const std::vector<Pose>& poses) {
    const Pose& first = poses.front();
    return std::all_of(poses.begin(), poses.end(), [&](const Pose& p) {
        return p.palette == first.palette && p.morph_weights == first.morph_weights &&
               std::equal(p.cameras.begin(), p.cameras.end(), first.cameras.begin(), same) &&
               std::equal(p.lights.begin(), p.lights.end(), first.lights.begin(), same);
    });
}

bool lights_still(const std::vector<Pose>& poses) {
    const Pose& first = poses.front();
    return std::all_of(poses.begin(), poses.end(),
                       [&](const Pose& p) { return std::equal(p.lights.begin(), p.lights.end(), first.lights.begin(), same); });
}

uint32_t camera_cells(uint32_t spp, uint32_t segments, bool still) {
    if (still) return segments;
    uint32_t best = 0;
    for (uint32_t cells = segments; cells <= std::max(kMostCells, segments); cells += segments) {
        if (spp % cells == 0) best = cells;
    }
    if (best >= std::min(kFewestCells, spp)) return best;
    // No divisor will do: strata straddle the cells' borders.
    return std::max(1u, kFewestCells / segments) * segments;
}

uint32_t light_cells(uint32_t segments, bool still) {
    if (still) return segments;
    return std::max(1u, kLightCells / segments) * segments;
}

uint64_t batch_slots(const gpu::Device& device, const shared::ViewGrid& grid, uint32_t spp, uint64_t budget,
                     uint64_t visibility_bytes) {
    uint64_t all = uint64_t(grid.tiles_x) * grid.tiles_y * spp * shared::kTileTexels;
    uint64_t left = budget - std::min(budget, device.live_bytes());
    uint64_t most =
        std::min({kBatchSlots, all, left / 4 / (kSlotBytes + visibility_bytes), device.limits().max_storage_range / 8});
    return std::max<uint64_t>(most / shared::kTileTexels, 1) * shared::kTileTexels;
}

std::vector<Batch> split_batches(const shared::ViewGrid& grid, uint32_t spp, uint64_t most_slots, uint32_t most_strata) {
    uint64_t items = most_slots / shared::kTileTexels;
    uint32_t strata = static_cast<uint32_t>(std::min<uint64_t>({spp, items, kMostStrata, most_strata}));
    uint32_t tiles = grid.tiles_x * grid.tiles_y;
    uint32_t tile_step = static_cast<uint32_t>(std::min<uint64_t>(tiles, items / strata));
    std::vector<Batch> batches;
    for (uint32_t s = 0; s < spp; s += strata) {
        for (uint32_t tile = 0; tile < tiles; tile += tile_step)
            batches.push_back({tile, std::min(tile_step, tiles - tile), s, std::min(strata, spp - s)});
    }
    return batches;
}

}  // namespace gnomon
