// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: times on the device.
#pragma once

#include "gpu/vulkan.hpp"

namespace gnomon::gpu {

/// Timestamps one after the other. Grows by pools. Any number of them. On a device without timestamps all times are 0.
class Timestamps {
public:
    explicit Timestamps(const Device::Impl& device);

    /// The time at which all that was recorded before is done.
    void record(VkCommandBuffer commands);
    /// From each to the next. The work must be done.
    std::vector<double> seconds_between() const;
    void reset() { count_ = 0; }

private:
    static constexpr uint32_t kPoolQueries = 1024;

    VkDevice device_;
    bool measured_;
    double seconds_per_tick_;
    uint64_t mask_;  // of the bits that count
    std::vector<OwnedQueryPool> pools_;
    size_t count_ = 0;
};

}  // namespace gnomon::gpu
