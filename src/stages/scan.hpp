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

/// Bytes that record_scan takes besides, until what it recorded is done.
uint64_t scan_work_bytes(uint64_t count);

/// Write the exclusive prefix sum of values[first, first + count) to sums[0, count) and the total to sums[count] (0xffffffff:
/// it does not fit into 32 bits). Two buffers, since what a stage reads through a texel view it must not write. What follows
/// the values up to a multiple of 4 must be zero before. first: a multiple of 64, which any device can bind from.
/// stage: what its time counts to.
Scan record_scan(gpu::Device& device, Programs& programs, const gpu::Buffer& values, uint32_t count, const gpu::Buffer& sums,
                 uint64_t first = 0, std::string_view stage = "scan");

}  // namespace gnomon
