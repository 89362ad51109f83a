// SPDX-License-Identifier: Apache-2.0
// Memory is kept for later buffers, within bounds, and no two buffers share any.
#include <optional>
#include <random>
#include <vector>

#include "gpu/vulkan.hpp"
#include "gpu_test.hpp"

namespace gnomon::gpu {
namespace {

constexpr uint64_t kMiB = uint64_t{1} << 20;

class PoolTest : public DeviceTest {
protected:
    uint64_t held_bytes() const {
        uint64_t held = 0;
        for (const auto& [type, pool] : device.impl()->pools) held += pool.held_bytes();
        return held;
    }
    static VkDeviceMemory memory_of(const Buffer& buffer) { return buffer.impl()->memory.piece.memory(); }
};

TEST_F(PoolTest, SmallBuffersShareABlock) {
    const Buffer first = device.allocate("first", 1000);
    const Buffer second = device.allocate("second", kMiB);
    EXPECT_EQ(memory_of(first), memory_of(second));
    EXPECT_EQ(held_bytes(), MemoryPool::kBlockBytes);
    EXPECT_EQ(device.live_bytes(), 1000 + kMiB);
}

TEST_F(PoolTest, LargeBuffersReuseBlocksOfTheirOwn) {
    std::optional<Buffer> large = device.allocate("large", 40 * kMiB);
    const VkDeviceMemory memory = memory_of(*large);
    const uint64_t held = held_bytes();
    EXPECT_GE(held, 40 * kMiB);
    EXPECT_LE(held, 45 * kMiB);
    large.reset();
    EXPECT_EQ(held_bytes(), held);
    const Buffer smaller = device.allocate("smaller", 30 * kMiB);
    EXPECT_EQ(memory_of(smaller), memory);
    EXPECT_NE(memory_of(device.allocate("tiny", 16)), memory) << "it would keep a large one out";
    EXPECT_NE(memory_of(device.allocate("another", 30 * kMiB)), memory);
}

TEST_F(PoolTest, MuchTooLargeBlocksAreNotUsed) {
    std::optional<Buffer> large = device.allocate("large", 64 * kMiB);
    const VkDeviceMemory memory = memory_of(*large);
    large.reset();
    EXPECT_NE(memory_of(device.allocate("smaller", 20 * kMiB)), memory);
}

TEST_F(PoolTest, GapsGrowTogether) {
    const auto fill_a_block = [&](uint64_t count) {
        std::vector<Buffer> buffers;
        for (uint64_t i = 0; i < count; ++i) buffers.push_back(device.allocate("part", MemoryPool::kBlockBytes / count));
        // Every second one goes first, so that each of the others has gaps on both sides.
        for (uint64_t i = 0; i < count; i += 2) buffers[i] = Buffer();
    };
    for (const uint64_t count : {64u, 8u, 16u, 32u}) {
        fill_a_block(count);
        EXPECT_EQ(held_bytes(), MemoryPool::kBlockBytes) << count;
    }
}

// Buffers of random sizes come and go; each keeps what was written to it.
TEST_F(PoolTest, NoTwoBuffersShareMemory) {
    std::mt19937 random(7);
    std::vector<Buffer> buffers(40);
    std::vector<uint32_t> first_values(buffers.size());
    for (uint32_t step = 0; step < 600; ++step) {
        const size_t i = random() % buffers.size();
        buffers[i] = Buffer();
        const auto count = static_cast<uint32_t>(1 + random() % (random() % 4 == 0 ? 100000 : 100));
        buffers[i] = upload_new(device, "random", iota(count, step << 20));
        first_values[i] = step << 20;
    }
    for (size_t i = 0; i < buffers.size(); ++i) {
        if (!buffers[i]) continue;
        const auto count = static_cast<uint32_t>(buffers[i].bytes() / sizeof(uint32_t));
        EXPECT_EQ(download_vector<uint32_t>(device, buffers[i], count), iota(count, first_values[i]));
    }
    const uint64_t staging = device.limits().mapped ? 0 : 32 * kMiB;
    EXPECT_EQ(held_bytes(), MemoryPool::kBlockBytes + staging);
}

TEST_F(PoolTest, KeepsWithinTheBudget) {
    device.set_budget(100 * kMiB);
    std::optional<Buffer> large = device.allocate("large", 80 * kMiB);
    large.reset();
    EXPECT_EQ(held_bytes(), 80 * kMiB);
    large = device.allocate("other", 32 * kMiB);
    EXPECT_EQ(held_bytes(), 32 * kMiB) << "both would pass the budget";
    large.reset();
    device.set_budget(16 * kMiB);
    EXPECT_EQ(held_bytes(), 0u);
    EXPECT_NO_THROW(device.allocate("within", 16 * kMiB));
}

TEST_F(PoolTest, ReleasesAllButWhatIsInUse) {
    device.allocate("kept", 32 * kMiB);
    const Buffer live = device.allocate("live", 16);
    EXPECT_EQ(held_bytes(), 32 * kMiB + MemoryPool::kBlockBytes);
    device.impl()->release_memory(0);
    EXPECT_EQ(held_bytes(), MemoryPool::kBlockBytes);
}

}  // namespace
}  // namespace gnomon::gpu
