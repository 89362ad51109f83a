// SPDX-License-Identifier: Apache-2.0
// PNG files read back, and sRGB values worked out by hand.
#include "io/png.hpp"

#include <gmock/gmock.h>
#include <png.h>

#include <limits>

#include "test_folder.hpp"
#include "throws.hpp"

namespace gnomon::test {

using ::testing::ElementsAre;

class PngTest : public TestFolder {};

TEST(Srgb, WorkedByHand) {
    EXPECT_EQ(io::srgb8(0.0), 0);
    EXPECT_EQ(io::srgb8(0.001), 3);       // 12.92 * 0.001 * 255 = 3.29
    EXPECT_EQ(io::srgb8(0.0031308), 10);  // 0.04045 * 255 = 10.31, where the two pieces meet
    EXPECT_EQ(io::srgb8(0.18), 118);      // 0.46136 * 255 = 117.65
    EXPECT_EQ(io::srgb8(0.5), 188);       // 0.73536 * 255 = 187.52
    EXPECT_EQ(io::srgb8(1.0), 255);
}

TEST(Srgb, OutOfRangeIsClamped) {
    EXPECT_EQ(io::srgb8(-1.0), 0);
    EXPECT_EQ(io::srgb8(7.0), 255);
    EXPECT_EQ(io::srgb8(std::numeric_limits<double>::infinity()), 255);
    EXPECT_EQ(io::srgb8(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(ToneMap, InterleavesAndExposes) {
    // In the order of an EXR file, with channels that play no part.
    const std::vector<Channel> channels = {{"A", {0, 0}}, {"B", {1.0f, 0.0f}}, {"G", {0.5f, 0.25f}}, {"R", {0.18f, 0.5f}}};
    EXPECT_THAT(io::tone_map(channels, 0.0), ElementsAre(118, 188, 255, 188, 137, 0));  // 0.25: 0.53710 * 255 = 136.96
    EXPECT_THAT(io::tone_map(channels, 1.0), ElementsAre(162, 255, 255, 255, 188, 0));  // 0.36: 0.63515 * 255 = 161.96
}

TEST(ToneMap, MissingChannelIsAnError) {
    const std::vector<Channel> channels = {{"R", {0}}, {"B", {0}}};
    EXPECT_GNOMON_ERROR(io::tone_map(channels, 0.0), ErrorKind::input, "without a channel G");
}

TEST_F(PngTest, ReadsBack) {
    const std::vector<uint8_t> rgb = {1, 2, 3, 4, 5, 6, 7, 8, 9, 250, 251, 252, 253, 254, 255, 0, 128, 64};
    io::write_png(folder / "a.png", 3, 2, rgb);
    EXPECT_EQ(names(), std::set<std::string>{"a.png"});

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()), 0) << image.message;
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.height, 2u);
    EXPECT_EQ(image.format & PNG_FORMAT_FLAG_ALPHA, 0u);
    image.format = PNG_FORMAT_RGB;
    std::vector<uint8_t> read(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0) << image.message;
    EXPECT_EQ(read, rgb);
}

TEST_F(PngTest, SaysThatItIsSrgb) {
    io::write_png(folder / "a.png", 1, 1, std::vector<uint8_t>{1, 2, 3});
    EXPECT_NE(content_of(folder / "a.png").find("sRGB"), std::string::npos);
}

TEST_F(PngTest, SameArgumentsGiveTheSameBytes) {
    const std::vector<uint8_t> rgb(300, 17);
    io::write_png(folder / "a.png", 10, 10, rgb);
    io::write_png(folder / "b.png", 10, 10, rgb);
    EXPECT_EQ(content_of(folder / "a.png"), content_of(folder / "b.png"));
}

TEST_F(PngTest, AnImageThatCannotBeWrittenIsAnError) {
    EXPECT_GNOMON_ERROR(io::write_png(folder / "none" / "a.png", 1, 1, std::vector<uint8_t>(3)), ErrorKind::input,
                        "create the folder first");
}

}  // namespace gnomon::test
