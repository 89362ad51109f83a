// SPDX-License-Identifier: Apache-2.0
#include "stages/scan.hpp"

#include <algorithm>

#include "shared/params.h"
#include "stages/grid.hpp"

namespace gnomon {
namespace {

// Up to this many values are scanned by one invocation.
constexpr uint32_t kSerialCount = 1024;

void record_level(gpu::Device& device, Programs& programs, gpu::Recorder& recorder, const gpu::Buffer& values,
                  uint64_t values_first, uint32_t count, const gpu::Buffer& sums, bool first_level, const Scan& scan,
                  std::string_view stage) {
    using gpu::Texel;
    const auto view = [&](Texel texel) {
        return gpu::Binding{"values", &values, texel, values_first * 4, groups_of(count, 4) * 16};
    };
    if (count <= kSerialCount) {
        recorder.dispatch(stage, programs.get("scan/serial", {first_level}),
                          bindings({view(Texel::r32_uint), {"Sums", &sums}, {"Longest", &scan.longest}}),
                          shared::ScanParams{count, 0, 1}, 1);
        return;
    }
    uint32_t run_count = static_cast<uint32_t>(groups_of(count, shared::kScanRun));
    const gpu::Buffer runs = device.allocate("scan_runs", scan_bytes(run_count));
    const gpu::Buffer before = device.allocate("scan_sums", scan_bytes(run_count));
    recorder.fill(stage, runs, 0);
    recorder.dispatch(stage, programs.get("scan/reduce", {first_level}),
                      bindings({view(Texel::rgba32_uint), {"Runs", &runs}, {"Longest", &scan.longest}}),
                      shared::ScanParams{count, 0, run_count}, groups_of(run_count, 64));
    record_level(device, programs, recorder, runs, 0, run_count, before, false, scan, stage);
    // The sums are written through bindings of what the device can bind at once; whole runs, and the total behind the last.
    uint64_t most_runs = std::max<uint64_t>(1, device.limits().max_storage_range / (4 * shared::kScanRun) - 1) / 64 * 64;
    for (uint64_t first = 0; first < run_count; first += most_runs) {
        uint32_t part = static_cast<uint32_t>(std::min<uint64_t>(most_runs, run_count - first));
        uint64_t offset = first * shared::kScanRun * 4;
        uint64_t bytes = first + part < run_count ? uint64_t(part) * shared::kScanRun * 4 : scan_bytes(count) - offset;
        recorder.dispatch(
            stage, programs.get("scan/spread"),
            bindings({view(Texel::rgba32_uint), {"runs", &before, Texel::r32_uint}, {"Sums", &sums, {}, offset, bytes}}),
            shared::ScanParams{count, static_cast<uint32_t>(first), part}, groups_of(part, 64));
    }
}

}  // namespace

uint64_t scan_bytes(uint64_t count) { return (count + 1 + 3) / 4 * 16; }

uint64_t scan_work_bytes(uint64_t count) {
    if (count <= kSerialCount) return 4;
    const uint64_t runs = groups_of(count, shared::kScanRun);
    return 2 * scan_bytes(runs) + scan_work_bytes(runs);
}

Scan record_scan(gpu::Device& device, Programs& programs, const gpu::Buffer& values, uint32_t count, const gpu::Buffer& sums,
                 uint64_t first, std::string_view stage) {
    gpu::Recorder& recorder = device.recorder();
    Scan scan;
    scan.longest = device.allocate("scan_longest", 4);
    recorder.fill(stage, scan.longest, 0);
    record_level(device, programs, recorder, values, first, count, sums, true, scan, stage);
    return scan;
}

}  // namespace gnomon
