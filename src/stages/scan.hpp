// SPDX-License-Identifier: Apache-2.0
// Exclusive prefix sums on the device.
#pragma once

#include "gpu/gpu.hpp"
#include "stages/programs.hpp"

namespace gnomon {

/// What one scan leaves besides its sums.
struct Scan {
    gpu::Buffer longest;  ///< The largest of the values.
};

/// Bytes of a buffer that can hold `count` values for record_scan, or their sums: the total behind them, padded to whole uvec4.
uint64_t scan_bytes(uint64_t count);

/// Write the exclusive prefix sum of values[0, count) to sums[0, count) and the total to sums[count] (0xffffffff: it does not
/// fit into 32 bits). Two buffers, since what a stage reads through a texel view it must not write. The padding of `values`
/// behind `count` must be zero before.
Scan record_scan(gpu::Device& device, Programs& programs, const gpu::Buffer& values, uint32_t count, const gpu::Buffer& sums);

}  // namespace gnomon
