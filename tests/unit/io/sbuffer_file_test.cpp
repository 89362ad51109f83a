// SPDX-License-Identifier: Apache-2.0
// Files of S-buffers come back as they were; what cannot be one is an error that names texel and range.
#include "io/sbuffer_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "io/exr.hpp"
#include "io/sbuffer_check.hpp"
#include "test_folder.hpp"
#include "throws.hpp"

namespace gnomon::test {

using ::testing::ElementsAre;

/// 3 x 2 texels: two ranges in (1, 0), three in (2, 1).
LightRanges small_light(bool exit_depths) {
    LightRanges light{3, 2, 1, exit_depths, {}};
    const auto add = [&](uint32_t texel, float enter, uint32_t triangle, float leave, float depth, float exit_depth) {
        light.ranges.push_back({texel, enter, triangle, leave, depth, exit_depths ? exit_depth : depth});
    };
    add(1, 0.0f, 7, 0.5f, 2.0f, 2.5f);
    add(1, 0.25f, 3, 1.0f, 4.0f, 3.0f);
    add(5, 0.125f, 1, 0.25f, 1.0f, 1.0f);
    add(5, 0.125f, 16777216, 0.25f, 1.5f, 2.0f);
    add(5, 0.5f, 0, 0.5f, -3.0f, -2.0f);
    return light;
}

class SBufferFileTest : public TestFolder {
protected:
    /// The file of a light whose i-th range was changed.
    io::SBufferFile changed(size_t i, const std::function<void(TexelRange&)>& change, bool exit_depths = false) {
        LightRanges light = small_light(exit_depths);
        change(light.ranges[i]);
        io::write_sbuffer(folder / "a.exr", light, {});
        return io::SBufferFile(folder / "a.exr");
    }
};

TEST_F(SBufferFileTest, ComesBackAsItWas) {
    for (const bool exit_depths : {false, true}) {
        const LightRanges light = small_light(exit_depths);
        io::write_sbuffer(folder / "a.exr", light, {{"gnomon:light", "4"}});
        const io::SBufferFile file(folder / "a.exr");
        EXPECT_EQ(file.width(), 3u);
        EXPECT_EQ(file.height(), 2u);
        EXPECT_EQ(file.exit_depths(), exit_depths);
        EXPECT_EQ(file.attributes(), (std::map<std::string, std::string>{{"gnomon:light", "4"}}));
        EXPECT_THAT(file.row(0).counts, ElementsAre(0, 2, 0));
        EXPECT_THAT(file.row(1).counts, ElementsAre(0, 0, 3));
        std::vector<io::FileRange> ranges = file.row(0).ranges;
        for (const io::FileRange& r : file.row(1).ranges) ranges.push_back(r);
        ASSERT_EQ(ranges.size(), light.ranges.size());
        for (size_t i = 0; i < ranges.size(); ++i) {
            const TexelRange& expected = light.ranges[i];
            EXPECT_EQ(ranges[i].enter, expected.enter);
            EXPECT_EQ(ranges[i].exit, expected.leave);
            EXPECT_EQ(ranges[i].enter_depth, expected.depth);
            EXPECT_EQ(ranges[i].exit_depth, expected.exit_depth);
            EXPECT_EQ(ranges[i].z, std::min(expected.depth, expected.exit_depth));
            EXPECT_EQ(ranges[i].z_back, std::max(expected.depth, expected.exit_depth));
            EXPECT_EQ(ranges[i].triangle, static_cast<float>(expected.triangle));
            EXPECT_EQ(ranges[i].alpha, 1.0f);
        }
    }
    EXPECT_EQ(names(), std::set<std::string>{"a.exr"});
}

TEST_F(SBufferFileTest, Summary) {
    io::write_sbuffer(folder / "a.exr", small_light(true), {});
    const io::SBufferSummary summary = io::check_sbuffer(io::SBufferFile(folder / "a.exr"));
    EXPECT_EQ(summary.ranges, 5u);
    EXPECT_EQ(summary.texels, 6u);
    EXPECT_EQ(summary.texels_with, 2u);
    EXPECT_EQ(summary.most, 3u);
    EXPECT_EQ(summary.most_x, 2u);
    EXPECT_EQ(summary.most_y, 1u);
    EXPECT_THAT(summary.histogram, ElementsAre(4, 0, 2));  // None; 1; 2 and 3.
    EXPECT_EQ(summary.triangles, 16777217u);
    EXPECT_EQ(summary.enter, 0.0f);
    EXPECT_EQ(summary.exit, 1.0f);
    EXPECT_EQ(summary.nearest, -3.0f);
    EXPECT_EQ(summary.farthest, 4.0f);
    EXPECT_EQ(summary.range_bytes, 5u * 8u * 4u);
    EXPECT_EQ(summary.file_bytes, std::filesystem::file_size(folder / "a.exr"));
}

TEST_F(SBufferFileTest, WithoutRanges) {
    io::write_sbuffer(folder / "a.exr", {4, 8, 1, false, {}}, {});
    const io::SBufferSummary summary = io::check_sbuffer(io::SBufferFile(folder / "a.exr"));
    EXPECT_EQ(summary.ranges, 0u);
    EXPECT_THAT(summary.histogram, ElementsAre(32));
    EXPECT_EQ(summary.triangles, 0u);
}

TEST_F(SBufferFileTest, WhatIsWrongIsNamedWithItsTexel) {
    const auto expect_fault = [&](size_t i, const std::function<void(TexelRange&)>& change, const std::string& text,
                                  bool exit_depths = false) {
        EXPECT_GNOMON_ERROR(io::check_sbuffer(changed(i, change, exit_depths)), ErrorKind::input, text);
    };
    EXPECT_NO_THROW(io::check_sbuffer(changed(0, [](TexelRange&) {})));
    EXPECT_NO_THROW(io::check_sbuffer(changed(0, [](TexelRange& r) { r.enter = -1e-6f; })));  // By rounding.
    expect_fault(
        0, [](TexelRange& r) { r.enter = -2e-5f; }, "texel 1,0, range 0 of 2: its time, -");
    expect_fault(
        1, [](TexelRange& r) { r.leave = 1.01f; }, "texel 1,0, range 1 of 2: its time, 0.25 to 1.0");
    expect_fault(
        3, [](TexelRange& r) { r.leave = 0.0f; }, "texel 2,1, range 1 of 3: it enters at 0.125 and leaves before");
    expect_fault(
        2, [](TexelRange& r) { r.depth = NAN; }, "texel 2,1, range 0 of 3: Z is nan");
    expect_fault(
        2, [](TexelRange& r) { r.exit_depth = INFINITY; }, "range 0 of 3: ZBack is inf");
    expect_fault(
        4, [](TexelRange& r) { r.leave = INFINITY; }, "range 2 of 3: time.exit is inf");
    expect_fault(
        4, [](TexelRange& r) { r.enter = r.leave = 0.1f; }, "texel 2,1, range 2 of 3: it is not sorted");
    expect_fault(
        3, [](TexelRange& r) { r.triangle = 0; }, "texel 2,1, range 1 of 3: it is not sorted");
}

TEST_F(SBufferFileTest, TrianglesThatAFloatDoesNotNumberAreRefused) {
    LightRanges light = small_light(false);
    light.ranges[3].triangle = 16777217;
    EXPECT_GNOMON_ERROR(io::write_sbuffer(folder / "a.exr", light, {}), ErrorKind::input, "16777216");
    EXPECT_EQ(names(), std::set<std::string>{});
}

TEST_F(SBufferFileTest, OtherFilesAreErrors) {
    EXPECT_GNOMON_ERROR(io::SBufferFile(folder / "none.exr"), ErrorKind::input, "no such file");
    put_content(folder / "text.exr", "this is not an image at all");
    EXPECT_GNOMON_ERROR(io::SBufferFile(folder / "text.exr"), ErrorKind::input, "text.exr");
    io::write_exr(folder / "flat.exr", 1, 1, std::vector<Channel>{{"Z", {1.0f}}}, {});
    EXPECT_GNOMON_ERROR(io::SBufferFile(folder / "flat.exr"), ErrorKind::input, "no deep scanlines");
    io::write_sbuffer(folder / "a.exr", small_light(false), {});
    std::string other = content_of(folder / "a.exr");
    other.replace(other.find("time.exit"), 9, "time.quit");
    put_content(folder / "other.exr", other);
    EXPECT_GNOMON_ERROR(io::SBufferFile(folder / "other.exr"), ErrorKind::input, "no channel time.exit");
    EXPECT_GNOMON_ERROR(io::read_exr(folder / "a.exr"), ErrorKind::input, "its pixels are deep");
}

TEST_F(SBufferFileTest, EveryTruncationIsAnError) {
    io::write_sbuffer(folder / "a.exr", small_light(true), {});
    const std::string whole = content_of(folder / "a.exr");
    for (size_t length = 0; length < whole.size(); length += 3) {
        put_content(folder / "part.exr", whole.substr(0, length));
        EXPECT_THROW(io::check_sbuffer(io::SBufferFile(folder / "part.exr")), Error)
            << length << " of " << whole.size() << " bytes";
    }
}

TEST_F(SBufferFileTest, DamageNeverEscapesAsAnotherException) {
    io::write_sbuffer(folder / "a.exr", small_light(true), {{"gnomon:scene", "a"}});
    const std::string whole = content_of(folder / "a.exr");
    for (size_t at = 0; at < whole.size(); ++at) {
        for (const char damage : {'\x00', '\xff'}) {
            std::string damaged = whole;
            damaged[at] = damage;
            put_content(folder / "damaged.exr", damaged);
            EXPECT_NO_THROW(error_of([&] { io::check_sbuffer(io::SBufferFile(folder / "damaged.exr")); })) << "byte " << at;
        }
    }
}

}  // namespace gnomon::test
