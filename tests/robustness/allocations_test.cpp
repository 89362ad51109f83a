// SPDX-License-Identifier: Apache-2.0
// Each allocation fails once, and all from one on: exit code 5, one line, no file; or a whole picture, where gnomon could do
// with less.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "support/paths.hpp"
#include "trials.hpp"
#include "unit/io/tiny_scene.hpp"

namespace gnomon::test {
namespace {

using Names = std::set<std::string>;

class Allocations : public RobustnessTest {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(GN_PATH(GNOMON_FAIL_ALLOCATION))) GTEST_SKIP() << "skipped: no fail_allocation.so";
        RobustnessTest::SetUp();
        put_content(folder / "a.gltf", tiny_scene());
    }

    CommandResult run(const std::string& what, uint64_t first, const char* count) {
        return run_gnomon(folder, what == "device" ? larger : render, [&] {
            if (what == "device") setenv("GNOMON_LIMITS", "mapped=0", 1);
            setenv("FAIL_ALLOCATION", what.c_str(), 1);
            setenv("FAIL_ALLOCATION_FIRST", std::to_string(first).c_str(), 1);
            setenv("FAIL_ALLOCATION_COUNT", count, 1);
            setenv("FAIL_ALLOCATION_REPORT", "report", 1);
            setenv("LD_PRELOAD", GN_PATH(GNOMON_FAIL_ALLOCATION).c_str(), 1);
        });
    }

    /// Without a failure.
    uint64_t count_of(const char* what) {
        const CommandResult result = run(what, 0, "0");
        EXPECT_EQ(result.exit_code, 0) << result.err;
        picture_ = content_of(folder / "a.exr");
        const uint64_t count = std::strtoull(content_of(folder / "report").c_str(), nullptr, 10);
        clean();
        return count;
    }

    void fail(const char* what, uint64_t first, const char* count) {
        SCOPED_TRACE(std::string(what) + " " + std::to_string(first) + " " + count);
        const CommandResult result = run(what, first, count);
        std::filesystem::remove(folder / "report");
        if (result.exit_code == 0) {
            ++done_;
            EXPECT_EQ(content_of(folder / "a.exr"), picture_);
            EXPECT_EQ(names(), (Names{"a.exr", "a.gltf", "a.json", "a.png"}));
        } else {
            ++refused_;
            EXPECT_EQ(result.exit_code, 5) << result.err;
            EXPECT_TRUE(result.err.starts_with("gnomon: error: ") &&
                        std::count(result.err.begin(), result.err.end(), '\n') == 1)
                << result.err;
            // What was whole before stays: a picture whose PNG could not be written.
            const Names left = names();
            for (const std::string& name : left) EXPECT_FALSE(name.starts_with(".gnomon-")) << name;
            if (left.contains("a.exr")) {
                EXPECT_EQ(content_of(folder / "a.exr"), picture_);
            }
        }
        clean();
    }

    void clean() {
        for (const char* name : {"a.exr", "a.png", "a.json", "report"}) std::filesystem::remove(folder / name);
    }

    const std::vector<std::string> render = {"render",       "a.gltf",  "-oa.exr", "--png=a.png",     "--json=a.json",
                                             "--size=16x16", "--spp=1", "--quiet", "--shadow-res=16", "--ground=auto"};
    // Of which some buffers have a block of memory of their own, and more memory is for copies.
    const std::vector<std::string> larger = {"render",        GN_PATH(GNOMON_SOURCE_DIR) + "/scenes/random-cubes.gltf",
                                             "-oa.exr",       "--png=a.png",
                                             "--json=a.json", "--size=320x240",
                                             "--spp=4",       "--quiet",
                                             "--pages=all",   "--time-steps=8"};
    size_t done_ = 0, refused_ = 0;

private:
    std::string picture_;
};

TEST_F(Allocations, OfDeviceMemory) {
    const uint64_t count = count_of("device");
    ASSERT_GT(count, 0u);
    for (uint64_t first = 1; first <= count; ++first) {
        fail("device", first, "1");
        fail("device", first, "");
    }
    std::printf("device: %llu allocations, %zu runs refused, %zu done with less\n", static_cast<unsigned long long>(count),
                refused_, done_);
    EXPECT_GT(refused_, 0u);
}

// The first third of the trials are the first allocations; the others are spread over the rest.
TEST_F(Allocations, OfHostMemory) {
    const uint64_t count = count_of("host");
    ASSERT_GT(count, 1000u);
    const size_t tried = trials(45), at_first = tried / 3;
    std::mt19937 random(1);
    for (size_t i = 0; i < tried; ++i) {
        uint64_t number = i + 1;
        if (i >= at_first) {
            const double share =
                (double(i - at_first) + std::uniform_real_distribution(0.0, 1.0)(random)) / double(tried - at_first);
            number = at_first + 1 + static_cast<uint64_t>(share * double(count - at_first - 1));
        }
        fail("host", number, "1");
    }
    std::printf("host: %llu allocations, %zu tried: %zu runs refused, %zu done with less\n",
                static_cast<unsigned long long>(count), tried, refused_, done_);
    EXPECT_GT(refused_, 0u);
}

}  // namespace
}  // namespace gnomon::test
