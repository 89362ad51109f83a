// SPDX-License-Identifier: Apache-2.0
// Buffers: contents, budget, statistics, lifetime.
#include <optional>
#include <utility>

#include "gpu/vulkan.hpp"
#include "gpu_test.hpp"

namespace gnomon::gpu {
namespace {

// The parameter: buffers are mapped where the device can (else staged), or always staged.
class Transfer : public testing::TestWithParam<bool> {
protected:
    void TearDown() override { EXPECT_THAT(device.validation_messages(), testing::IsEmpty()); }

    ScopedVariable limits{"GNOMON_LIMITS", GetParam() ? "mapped=0" : ""};
    Device device{"", true};
};

TEST_P(Transfer, IsAsAskedFor) {
    if (GetParam()) {
        EXPECT_FALSE(device.limits().mapped);
    }
    EXPECT_EQ(device.allocate("buffer", 64).impl()->memory.mapped != nullptr, device.limits().mapped);
}

TEST_P(Transfer, RoundTripWithOffsets) {
    const Buffer buffer = upload_new(device, "numbers", iota(1000));
    EXPECT_EQ(buffer.bytes(), 4000u);
    EXPECT_EQ(download_vector<uint32_t>(device, buffer, 1000), iota(1000));
    EXPECT_EQ(download_vector<uint32_t>(device, buffer, 10, 400), iota(10, 100));
    const std::vector<uint32_t> patch = iota(3, 77);
    upload(device, buffer, std::as_bytes(std::span(patch)), 8);
    const auto read = download_vector<uint32_t>(device, buffer, 6);
    EXPECT_THAT(read, testing::ElementsAre(0, 1, 77, 78, 79, 5));
}

TEST_P(Transfer, LargerThanTheStagingBuffer) {
    const auto count = static_cast<uint32_t>(2 * kStagingBytes / sizeof(uint32_t) + 3);
    const Buffer buffer = upload_new(device, "large", iota(count));
    EXPECT_EQ(download_vector<uint32_t>(device, buffer, count), iota(count));
}

TEST_P(Transfer, OutOfRangeIsAnError) {
    const Buffer buffer = device.allocate("small", 64);
    std::vector<std::byte> data(65);
    expect_error(ErrorKind::internal, {"upload", "small", "64"}, [&] { upload(device, buffer, data); });
    expect_error(ErrorKind::internal, {"download", "small"}, [&] { download(device, buffer, std::span(data).first(1), 64); });
    expect_error(ErrorKind::internal, {"upload"}, [&] { upload(device, buffer, std::span(data).first(1), ~uint64_t{0}); });
    expect_error(ErrorKind::internal, {"empty buffer"}, [&] { upload(device, Buffer(), std::span(data).first(0)); });
    Device other("", false);
    expect_error(ErrorKind::internal, {"another device", "small"}, [&] { upload(other, buffer, std::span(data).first(1)); });
}

INSTANTIATE_TEST_SUITE_P(, Transfer, testing::Bool(),
                         [](const auto& test) { return test.param ? "Staged" : "AsTheDeviceCan"; });

using BufferTest = DeviceTest;

TEST_F(BufferTest, ZeroBytesGivesTheSmallest) {
    const Buffer buffer = upload_new(device, "empty", std::vector<uint32_t>());
    ASSERT_TRUE(buffer);
    EXPECT_EQ(buffer.bytes(), 16u);
    EXPECT_EQ(Buffer().bytes(), 0u);
    EXPECT_FALSE(Buffer());
}

TEST_F(BufferTest, StatisticsFollowAllocations) {
    EXPECT_EQ(device.live_bytes(), 0u);
    std::optional<Buffer> first = device.allocate("first", 1000);
    {
        const Buffer second = device.allocate("second", 3000);
        const Buffer again = device.allocate("first", 200);
        EXPECT_EQ(device.live_bytes(), 4200u);
    }
    EXPECT_EQ(device.live_bytes(), 1000u);
    EXPECT_EQ(device.peak_bytes(), 4200u);
    EXPECT_EQ(device.largest_bytes(), (std::map<std::string, uint64_t>{{"first", 1000}, {"second", 3000}}));
    device.reset_statistics();
    EXPECT_EQ(device.peak_bytes(), 1000u);
    EXPECT_EQ(device.largest_bytes(), (std::map<std::string, uint64_t>{{"first", 1000}})) << "what is there now";
    first.reset();
    EXPECT_EQ(device.live_bytes(), 0u);
}

TEST_F(BufferTest, BudgetHolds) {
    device.set_budget(1 << 20);
    std::optional<Buffer> half = device.allocate("half", 1 << 19);
    expect_error(ErrorKind::out_of_memory, {"'too much'", "512.0 KiB", "1.0 MiB", "half", "larger --memory-budget"},
                 [&] { device.allocate("too much", (1 << 19) + 1); });
    EXPECT_EQ(device.live_bytes(), uint64_t{1} << 19);
    EXPECT_NO_THROW(device.allocate("other half", 1 << 19));
    half.reset();
    EXPECT_NO_THROW(device.allocate("all", 1 << 20));
    device.set_budget(1);
    EXPECT_THROW(device.allocate("more", 16), Error);
    device.set_budget(0);
    EXPECT_NO_THROW(device.allocate("no limit", 1 << 21));
}

TEST_F(BufferTest, LargerThanTheDeviceAllows) {
    expect_error(ErrorKind::out_of_memory, {"'huge'", "at most"},
                 [&] { device.allocate("huge", device.limits().max_buffer_bytes + 1); });
    expect_error(ErrorKind::out_of_memory, {"'endless'"}, [&] { device.allocate("endless", ~uint64_t{0}); });
    EXPECT_EQ(device.live_bytes(), 0u);
}

TEST_F(BufferTest, MovesItsMemory) {
    Buffer from = upload_new(device, "moved", iota(4));
    Buffer to = std::move(from);
    EXPECT_FALSE(from);  // NOLINT(bugprone-use-after-move): what it then is
    EXPECT_EQ(download_vector<uint32_t>(device, to, 4), iota(4));
    Buffer replaced = device.allocate("replaced", 64);
    replaced = std::move(to);
    EXPECT_EQ(device.live_bytes(), 16u);
    EXPECT_EQ(download_vector<uint32_t>(device, replaced, 4), iota(4));
}

TEST(BufferLifetime, MayOutliveItsDevice) {
    std::optional<Device> device(std::in_place, "", true);
    Buffer buffer = device->allocate("survivor", 64);
    device.reset();
    EXPECT_EQ(buffer.bytes(), 64u);
    buffer = Buffer();  // frees the device; sanitizers and the driver would object
}

}  // namespace
}  // namespace gnomon::gpu
