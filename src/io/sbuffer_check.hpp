// SPDX-License-Identifier: Apache-2.0
// What is in the file of an S-buffer, and whether it can be one.
#pragma once

#include "io/sbuffer_file.hpp"

namespace gnomon::io {

struct SBufferSummary {
    uint64_t ranges = 0;
    uint64_t texels = 0;       ///< Of all faces.
    uint64_t texels_with = 0;  ///< That have a range.
    uint32_t most = 0;         ///< Ranges of a texel; the first that has so many is
    uint32_t most_x = 0, most_y = 0;
    /// Texels by their ranges: [0] has none, [i] has 2^(i - 1) to 2^i - 1; as long as needed.
    std::vector<uint64_t> histogram;
    uint32_t triangles = 0;                                            ///< One more than the largest number.
    float enter = 0.0f, exit = 0.0f, nearest = 0.0f, farthest = 0.0f;  ///< Of all ranges; 0 where there are none.
    uint64_t file_bytes = 0;
    uint64_t range_bytes = 0;  ///< Without compression.
};

/// Reads all of it. Errors: ErrorKind::input, naming texel and range, where a value is not finite, times are not in order or
/// more than 1e-5 outside of 0 to 1, depths are not in order, a triangle's number is not whole, A is not 1, or ranges are not
/// sorted; also those of SBufferFile.
SBufferSummary check_sbuffer(const SBufferFile& file);

}  // namespace gnomon::io
