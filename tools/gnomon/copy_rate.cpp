// SPDX-License-Identifier: Apache-2.0
#include "copy_rate.hpp"

#include "gpu/gpu.hpp"
#include "timing/clocks.hpp"
#include "timing/summary.hpp"

namespace gnomon::cli {

double copy_rate(const std::string& device_choice) {
    constexpr uint64_t kBytes = uint64_t{64} << 20;
    constexpr int kCopies = 9;
    gpu::Device device(device_choice, false);
    const gpu::Buffer from = device.allocate("copied", kBytes), to = device.allocate("copy", kBytes);
    gpu::Recorder& recorder = device.recorder();
    // Memory is the system's to give when it is first written.
    recorder.fill("fill", from, 1);
    recorder.fill("fill", to, 0);
    recorder.copy("copy", from, 0, to, 0, kBytes);
    recorder.submit();
    std::vector<double> rates;
    for (int i = 0; i < kCopies; ++i) {
        device.reset_statistics();
        const timing::Seconds start = timing::now();
        recorder.copy("copy", from, 0, to, 0, kBytes);
        recorder.submit();
        const double wall = (timing::now() - start).wall;
        const double seconds = device.has_timestamps() ? device.stage_times().at(0).seconds : wall;
        rates.push_back(static_cast<double>(kBytes) / (seconds > 0.0 ? seconds : wall));
    }
    return timing::summarize(std::move(rates)).median;
}

}  // namespace gnomon::cli
