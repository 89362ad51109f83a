// SPDX-License-Identifier: Apache-2.0
// Query pools of timestamps.
#include "gpu/timestamps.hpp"

#include <algorithm>
#include <limits>

namespace gnomon::gpu {

Timestamps::Timestamps(const Device::Impl& device)
    : device_(device.device.get()),
      measured_(device.limits.timestamps),
      seconds_per_tick_(1e-9 * static_cast<double>(device.vulkan_limits.timestampPeriod)),
      mask_(measured_ ? std::numeric_limits<uint64_t>::max() >> (64 - device.candidate.timestamp_bits) : 0) {}

void Timestamps::record(VkCommandBuffer commands) {
    if (!measured_) {
        ++count_;
        return;
    }
    const size_t pool = count_ / kPoolQueries;
    const auto query = static_cast<uint32_t>(count_ % kPoolQueries);
    if (pool == pools_.size()) {
        const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                         .queryCount = kPoolQueries};
        pools_.push_back(create<OwnedQueryPool>(device_, vkCreateQueryPool, info, "a query pool"));
    }
    if (query == 0) vkCmdResetQueryPool(commands, pools_[pool].get(), 0, kPoolQueries);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[pool].get(), query);
    ++count_;
}

std::vector<double> Timestamps::seconds_between() const {
    std::vector<double> seconds(count_ > 0 ? count_ - 1 : 0, 0.0);
    if (!measured_) return seconds;
    std::vector<uint64_t> ticks(count_);
    for (size_t first = 0; first < count_; first += kPoolQueries) {
        const size_t count = std::min<size_t>(kPoolQueries, count_ - first);
        check(vkGetQueryPoolResults(device_, pools_[first / kPoolQueries].get(), 0, static_cast<uint32_t>(count),
                                    count * sizeof(uint64_t), ticks.data() + first, sizeof(uint64_t),
                                    VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
              "read timestamps");
    }
    for (size_t i = 0; i < seconds.size(); ++i) {
        seconds[i] = static_cast<double>((ticks[i + 1] - ticks[i]) & mask_) * seconds_per_tick_;
    }
    return seconds;
}

}  // namespace gnomon::gpu
