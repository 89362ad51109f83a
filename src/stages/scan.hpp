// SPDX-License-Identifier: Apache-2.0
// Exclusive prefix sums on the device.
#pragma once

#include "gpu/gpu.hpp"
#include "pipeline/programs.hpp"

namespace gnomon {

/// What one scan leaves besides its sums. Keep until the recorder has run.
struct Scan {
    gpu::Buffer longest;
};

/// Bytes of a buffer that can hold `count` values for record_scan, or their sums: the total behind them, padded to whole uvec4.
uint64_t scan_bytes(uint64_t count);

/// Write the exclusive prefix sum of values[0, count) to sums[0, count) and the total to sums[count] (0xffffffff: it does not
/// fit into 32 bits). Two buffers, since what a stage reads through a texel view it must not write. The padding of `values`
/// behind `count` must be zero before.
Scan record_scan(gpu::Device& device, Programs& programs, gpu::Recorder& recorder, const gpu::Buffer& values, uint32_t count,
                 const gpu::Buffer& sums);

/// The largest of the values that were scanned. After the recorder has run.
uint32_t longest_of(gpu::Device& device, const Scan& scan);

}  // namespace gnomon
