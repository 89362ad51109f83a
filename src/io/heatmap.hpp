// SPDX-License-Identifier: Apache-2.0
// Numbers of a map, as colours with a scale beside them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::io {

/// sRGB, 3 bytes per pixel, rows from the top.
struct Heatmap {
    uint32_t width = 0;  ///< More than the map's, by the scale to its right.
    uint32_t height = 0;
    std::vector<uint8_t> rgb;
};

/// The colour of a share from 0 to 1: viridis, whose lightness grows evenly.
std::array<uint8_t, 3> viridis(double share);

/// A map of width * counts.size() / width texels, a pixel each at its upper left: nothing is black, 1 is dark blue, the most is
/// yellow, between them colours follow the logarithm. The scale has its numbers at powers of two and at the most.
Heatmap heatmap(std::span<const uint32_t> counts, uint32_t width);

}  // namespace gnomon::io
