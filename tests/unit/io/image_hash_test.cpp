// SPDX-License-Identifier: Apache-2.0
// The hash of a picture changes with every bit that is of it, and with nothing else.
#include "io/image_hash.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace gnomon::io {
namespace {

TEST(ImageHash, DependsOnSizesNamesAndBits) {
    const std::vector<Channel> channels = {{"R", {1.0f, 0.0f}}, {"Z", {2.0f, 3.0f}}};
    std::set<uint64_t> hashes = {image_hash(2, 1, channels)};
    size_t kinds = 1;
    const auto expect_another = [&](uint32_t width, uint32_t height, const std::vector<Channel>& others) {
        hashes.insert(image_hash(width, height, others));
        EXPECT_EQ(hashes.size(), ++kinds);
    };
    expect_another(1, 2, channels);
    expect_another(2, 1, {{"R", {1.0f, 0.0f}}});
    expect_another(2, 1, {{"R", {1.0f, 0.0f}}, {"Y", {2.0f, 3.0f}}});
    expect_another(2, 1, {{"Z", {1.0f, 0.0f}}, {"R", {2.0f, 3.0f}}});
    expect_another(2, 1, {{"R", {1.0f, -0.0f}}, {"Z", {2.0f, 3.0f}}});
    expect_another(2, 1, {{"R", {0.0f, 1.0f}}, {"Z", {2.0f, 3.0f}}});
    expect_another(2, 1, {{"R", {1.0f, std::numeric_limits<float>::quiet_NaN()}}, {"Z", {2.0f, 3.0f}}});
    expect_another(2, 1, {{"R", {1.0f, -std::numeric_limits<float>::quiet_NaN()}}, {"Z", {2.0f, 3.0f}}});
}

TEST(ImageHash, IsTheSameInAnyOrderOfChannels) {
    EXPECT_EQ(image_hash(1, 1, std::vector<Channel>{{"R", {1.0f}}, {"Z", {2.0f}}}),
              image_hash(1, 1, std::vector<Channel>{{"Z", {2.0f}}, {"R", {1.0f}}}));
}

// FNV-1a of the words 1, 1, 1, 'R' and the bits of 1, by hand in another language: files may be compared by what was written
// down.
TEST(ImageHash, StaysWhatItIs) {
    EXPECT_EQ(hash_text(image_hash(1, 1, std::vector<Channel>{{"R", {1.0f}}})), "f067b1fa188b7350");
    EXPECT_EQ(hash_text(0x1f), "000000000000001f");
}

}  // namespace
}  // namespace gnomon::io
