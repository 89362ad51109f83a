// SPDX-License-Identifier: Apache-2.0
// EXR files come back bit for bit; damaged ones are errors.
#include "io/exr.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include "test_folder.hpp"
#include "throws.hpp"

namespace gnomon::test {

using ::testing::ElementsAre;

class ExrTest : public TestFolder {};

std::vector<uint32_t> bits_of(const std::vector<float>& values) {
    std::vector<uint32_t> bits;
    for (const float value : values) bits.push_back(std::bit_cast<uint32_t>(value));
    return bits;
}

/// From now on this process has so many bytes at most. Gives what it had.
rlimit limit_memory(uint64_t bytes) {
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
#if !defined(__SANITIZE_ADDRESS__)  // Whose shadow memory needs more than any limit.
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
#else
    (void)bytes;
#endif
    return before;
}

std::vector<Channel> some_channels() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return {{"R", {0.0f, -0.0f, 1.0f, 1.0f / 3.0f, 1e-45f, 3e38f}},
            {"Z", {kInfinity, -kInfinity, std::bit_cast<float>(0x7fc01234u), 1e-38f, -2.5f, 16777217.0f}},
            {"visibility_var.a_light_with_a_name_longer_than_31_characters", {1, 2, 3, 4, 5, 6}}};
}

TEST_F(ExrTest, ComesBackBitForBit) {
    const auto channels = some_channels();
    const std::map<std::string, std::string> attributes = {
        {"gnomon:spp", "16"}, {"gnomon:scene", "büro \"1\".glb"}, {"empty", ""}};
    io::write_exr(folder / "a.exr", 3, 2, channels, attributes);
    const io::ExrImage image = io::read_exr(folder / "a.exr");
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.height, 2u);
    ASSERT_EQ(image.channels.size(), channels.size());
    for (size_t i = 0; i < channels.size(); ++i) {
        EXPECT_EQ(image.channels[i].name, channels[i].name);
        EXPECT_EQ(bits_of(image.channels[i].values), bits_of(channels[i].values)) << channels[i].name;
    }
    EXPECT_EQ(image.attributes, attributes);
    EXPECT_EQ(names(), std::set<std::string>{"a.exr"});
}

TEST_F(ExrTest, FindsChannelsByName) {
    io::write_exr(folder / "a.exr", 3, 2, some_channels(), {});
    const io::ExrImage image = io::read_exr(folder / "a.exr");
    ASSERT_NE(image.find("Z"), nullptr);
    EXPECT_EQ(image.find("Z")->name, "Z");
    EXPECT_EQ(image.find("z"), nullptr);
}

TEST_F(ExrTest, SameArgumentsGiveTheSameBytes) {
    io::write_exr(folder / "a.exr", 3, 2, some_channels(), {{"gnomon:seed", "1"}});
    io::write_exr(folder / "b.exr", 3, 2, some_channels(), {{"gnomon:seed", "1"}});
    const std::string a = content_of(folder / "a.exr");
    EXPECT_FALSE(a.empty());
    EXPECT_EQ(a, content_of(folder / "b.exr"));
}

TEST_F(ExrTest, HalfAndIntegerChannelsBecomeFloatAndTheWindowMayBeAnywhere) {
    const std::vector<uint16_t> half = {0x3c00, 0xc000};  // 1, -2
    const std::vector<uint32_t> whole = {7, 65536};
    const Imath::Box2i window({5, -3}, {6, -3});
    Imf::Header header(window, window);
    header.channels().insert("half", Imf::Channel(Imf::HALF));
    header.channels().insert("whole", Imf::Channel(Imf::UINT));
    Imf::FrameBuffer buffer;
    buffer.insert("half", Imf::Slice::Make(Imf::HALF, half.data(), window));
    buffer.insert("whole", Imf::Slice::Make(Imf::UINT, whole.data(), window));
    {
        Imf::OutputFile file((folder / "a.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    const io::ExrImage image = io::read_exr(folder / "a.exr");
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    ASSERT_EQ(image.channels.size(), 2u);
    EXPECT_THAT(image.channels[0].values, ElementsAre(1.0f, -2.0f));
    EXPECT_THAT(image.channels[1].values, ElementsAre(7.0f, 65536.0f));
}

TEST_F(ExrTest, SubsampledChannelsAreRefused) {
    Imf::Header header(4, 4);
    header.channels().insert("BY", Imf::Channel(Imf::FLOAT, 2, 2));
    const std::vector<float> values(4);
    Imf::FrameBuffer buffer;
    buffer.insert("BY", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 4, 8, 2, 2));
    {
        Imf::OutputFile file((folder / "a.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(4);
    }
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "a.exr"), ErrorKind::input, "BY is subsampled");
}

// The file of a small image whose header says that its data window ends elsewhere.
std::string with_window(std::string file, int32_t last_x, int32_t last_y) {
    const std::string name("dataWindow\0box2i\0", 17);
    const size_t at = file.find(name) + name.size() + 4 + 8;  // Behind the size, and the window's first pixel.
    std::memcpy(file.data() + at, &last_x, 4);
    std::memcpy(file.data() + at + 4, &last_y, 4);
    return file;
}

TEST_F(ExrTest, AttributesThatAreLongerThanTheFileAreErrorsBeforeMemoryIsTaken) {
    io::write_exr(folder / "a.exr", 1, 1, std::vector{Channel{"R", {1.0f}}}, {{"note", "text"}});
    const std::string whole = content_of(folder / "a.exr");
    for (const std::string& name : {std::string("note\0string\0", 12), std::string("dataWindow\0box2i\0", 17)}) {
        for (const uint32_t bytes : {uint32_t(whole.size()), 0x7fffffffu, 0xffffffffu}) {
            std::string file = whole;
            std::memcpy(file.data() + file.find(name) + name.size(), &bytes, 4);
            put_content(folder / "a.exr", file);
            EXPECT_GNOMON_ERROR(io::read_exr(folder / "a.exr"), ErrorKind::input, "promises more than the file holds");
        }
    }
    // A list of channels is read to its end: what says that it is shorter hides what comes next.
    std::string shorter = whole;
    --shorter[shorter.find(std::string("chlist\0", 7)) + 7];
    put_content(folder / "a.exr", shorter);
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "a.exr"), ErrorKind::input, "not as long as it says");
    // In the header of a later part, too.
    std::string parts = whole;
    parts[5] |= 0x10;
    const size_t end = parts.find(std::string("screenWindowWidth\0float\0", 24)) + 24 + 8;
    ASSERT_EQ(parts[end], '\0');
    parts.insert(end + 1, std::string("note\0string\0\xff\xff\xff\x7f", 16));
    put_content(folder / "a.exr", parts);
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "a.exr"), ErrorKind::input, "promises more than the file holds");
}

TEST_F(ExrTest, HeadersThatPromiseTooMuchAreErrorsBeforeMemoryIsTaken) {
    // Noise, so that the file could be that of a larger image by its size.
    Channel noise{"R", {}};
    uint32_t state = 1;
    for (int i = 0; i < 256 * 256; ++i) noise.values.push_back(static_cast<float>(state = state * 1664525u + 1013904223u));
    io::write_exr(folder / "a.exr", 256, 256, std::vector{noise}, {});
    const std::string whole = content_of(folder / "a.exr");
    for (const auto& [x, y, text] : std::vector<std::tuple<int, int, const char*>>{{32767, 32767, "maximum"},
                                                                                   {255, 1 << 30, "data window"},
                                                                                   {1 << 30, 255, "data window"},
                                                                                   {16383, 16383, "promises more pixels"},
                                                                                   {255, 511, "wide.exr"}}) {
        put_content(folder / "wide.exr", with_window(whole, x, y));
        const rlimit before = limit_memory(uint64_t{1} << 30);
        EXPECT_GNOMON_ERROR(io::read_exr(folder / "wide.exr"), ErrorKind::input, text);
        setrlimit(RLIMIT_AS, &before);
    }
    put_content(folder / "same.exr", with_window(whole, 255, 255));
    EXPECT_EQ(io::read_exr(folder / "same.exr").channels[0].values, noise.values);
}

TEST_F(ExrTest, MissingAndForeignFilesAreErrors) {
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "none.exr"), ErrorKind::input, "no such file");
    EXPECT_GNOMON_ERROR(io::read_exr(folder), ErrorKind::input, "not a regular file");
    put_content(folder / "text.exr", "this is not an image at all");
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "text.exr"), ErrorKind::input, "text.exr");
    put_content(folder / "empty.exr", "");
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "empty.exr"), ErrorKind::input, "empty.exr");
}

TEST_F(ExrTest, EveryTruncationIsAnError) {
    io::write_exr(folder / "a.exr", 3, 2, some_channels(), {});
    const std::string whole = content_of(folder / "a.exr");
    for (size_t length = 0; length < whole.size(); ++length) {
        put_content(folder / "part.exr", whole.substr(0, length));
        EXPECT_THROW(io::read_exr(folder / "part.exr"), Error) << length << " of " << whole.size() << " bytes";
    }
}

TEST_F(ExrTest, DamageNeverEscapesAsAnotherException) {
    io::write_exr(folder / "a.exr", 3, 2, some_channels(), {{"gnomon:scene", "a"}});
    const std::string whole = content_of(folder / "a.exr");
    for (size_t at = 0; at < whole.size(); ++at) {
        for (const char damage : {'\x00', '\x7f', '\xff'}) {
            std::string damaged = whole;
            damaged[at] = damage;
            put_content(folder / "damaged.exr", damaged);
            EXPECT_NO_THROW(error_of([&] { io::read_exr(folder / "damaged.exr"); })) << "byte " << at;
        }
    }
}

TEST_F(ExrTest, AnImageThatCannotBeWrittenIsAnError) {
    EXPECT_GNOMON_ERROR(io::write_exr(folder / "none" / "a.exr", 3, 2, some_channels(), {}), ErrorKind::input,
                        "create the folder first");
}

}  // namespace gnomon::test
