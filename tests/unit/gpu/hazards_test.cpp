// SPDX-License-Identifier: Apache-2.0
// Where barriers are, without a device.
#include "gpu/hazards.hpp"

#include <array>

#include "gpu_test.hpp"

namespace gnomon::gpu {
namespace {

class HazardsTest : public testing::Test {
protected:
    bool read(const int& buffer, uint64_t begin = 0, uint64_t end = 64) { return add(buffer, begin, end, false); }
    bool write(const int& buffer, uint64_t begin = 0, uint64_t end = 64) { return add(buffer, begin, end, true); }
    bool add(const int& buffer, uint64_t begin, uint64_t end, bool is_write) {
        return hazards.add(std::array{Access{&buffer, begin, end, is_write}});
    }

    int a = 0;
    int b = 0;
    Hazards hazards;
};

TEST_F(HazardsTest, AnythingAfterAWriteAndAWriteAfterAnything) {
    EXPECT_FALSE(write(a));
    EXPECT_TRUE(read(a));
    EXPECT_FALSE(read(a)) << "the barrier before serves all reads";
    EXPECT_TRUE(write(a));
    EXPECT_TRUE(write(a));
}

TEST_F(HazardsTest, OtherBuffersAndOtherBytesDoNotWait) {
    EXPECT_FALSE(write(a, 0, 64));
    EXPECT_FALSE(write(b, 0, 64));
    EXPECT_FALSE(write(a, 64, 128));
    EXPECT_FALSE(read(a, 128, 129));
    EXPECT_TRUE(read(a, 127, 128));
}

TEST_F(HazardsTest, ABarrierIsForAllThatWasBefore) {
    EXPECT_FALSE(write(a));
    EXPECT_FALSE(write(b));
    EXPECT_TRUE(read(a));
    EXPECT_FALSE(read(b));
    EXPECT_TRUE(write(b)) << "what was read since is not";
}

TEST_F(HazardsTest, AWriteIsSeenBehindAReadOfMore) {
    EXPECT_FALSE(read(a, 0, 1000));
    EXPECT_FALSE(read(a, 10, 20));
    EXPECT_TRUE(write(a, 15, 16));
    EXPECT_TRUE(read(a, 0, 1000));
}

TEST_F(HazardsTest, OneCommandDoesNotWaitForItself) {
    EXPECT_FALSE(hazards.add(std::array{Access{&a, 0, 8, false}, Access{&b, 0, 8, true}, Access{&a, 0, 8, false}}));
    EXPECT_TRUE(hazards.add(std::array{Access{&a, 0, 8, false}, Access{&b, 0, 8, false}}));
    hazards.clear();
    EXPECT_FALSE(write(a));
}

TEST_F(HazardsTest, SomeBarrierComesAtLast) {
    bool barrier = false;
    for (uint64_t i = 0; i < 10000; ++i) barrier = write(a, i, i + 1) || barrier;
    EXPECT_TRUE(barrier);
}

}  // namespace
}  // namespace gnomon::gpu
