// SPDX-License-Identifier: Apache-2.0
// Exclusive prefix sums on the device.
#pragma once

#include "gpu/gpu.hpp"
#include "pipeline/programs.hpp"

namespace gnomon {

/// Buffers of one scan. Keep until the recorder has run.
struct Scan {
    std::vector<gpu::Buffer> sums;  ///< One per level.
    gpu::Buffer longest;
};

/// Bytes of a buffer that can hold `count` values for record_scan: the total behind them, padded to whole uvec4.
uint64_t scan_bytes(uint64_t count);

/// Replace values[0, count) by their exclusive prefix sum and values[count] by the total (0xffffffff: it does not fit into 32
/// bits). The padding behind `count` must be zero before. name: of the stage's rows in the timings ("scan").
Scan record_scan(gpu::Device& device, Programs& programs, gpu::Recorder& recorder, const gpu::Buffer& values, uint32_t count);

/// The largest of the values that were scanned. After the recorder has run.
uint32_t longest_of(gpu::Device& device, const Scan& scan);

}  // namespace gnomon
