// SPDX-License-Identifier: Apache-2.0
#include "stages/cells.hpp"

#include <algorithm>

namespace gnomon {
namespace {

// More cells cut the tests of fast prisms and list slow ones again in each.
constexpr uint32_t kFewestCells = 8;
constexpr uint32_t kMostCells = 16;
constexpr uint32_t kLightCells = 4;

}  // namespace

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

uint32_t light_cells(uint32_t segments, bool still, uint32_t asked) {
    if (asked > 0) return asked;
    if (still) return segments;
    return std::max(1u, kLightCells / segments) * segments;
}

bool worth_apart(uint64_t still_triangles, uint64_t triangles, uint32_t cells) {
    return still_triangles * (cells - 1) > triangles;
}

bool worth_sampling(uint64_t triangles, uint64_t pixels) { return 2 * triangles >= pixels; }

}  // namespace gnomon
