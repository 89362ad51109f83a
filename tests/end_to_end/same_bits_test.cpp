// SPDX-License-Identifier: Apache-2.0
// The picture's bits do not depend on the subgroup size nor on the version of the driver. Both are chosen before a process
// makes its device, by environment: each hash comes from a process of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "support/paths.hpp"

namespace gnomon::test {
namespace {

std::string output_of(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return "popen failed";
    std::string text;
    for (char buffer[256]; std::fgets(buffer, sizeof buffer, pipe) != nullptr;) text += buffer;
    return pclose(pipe) == 0 ? text : "failed: " + text;
}

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// lavapipe with vectors of `bits`, 0: as it is; on the driver with the manifest `icd`, none: on that of this process. lavapipe
/// takes code of another width from its cache, so each has a cache of its own, or none where no folder is given.
std::string environment(int bits, const std::string& icd) {
    const std::string caches = variable("GNOMON_SHADER_CACHES");
    const std::string cache = caches + "/same_bits_" + std::to_string(bits) + (icd.empty() ? "" : "_second_driver");
    std::string text = caches.empty() ? "MESA_SHADER_CACHE_DISABLE=true " : "MESA_SHADER_CACHE_DIR='" + cache + "' ";
    if (bits != 0) text += "LP_NATIVE_VECTOR_WIDTH=" + std::to_string(bits) + " ";
    if (!icd.empty()) text += "VK_DRIVER_FILES='" + icd + "' VK_ICD_FILENAMES='" + icd + "' ";
    return text;
}

/// What `gnomon devices` says of the one that would be used.
std::string device(const std::string& environment) {
    const std::string text = output_of(environment + "'" + GN_PATH(GNOMON_COMMAND) + "' devices");
    return text.substr(0, text.find('\n'));
}

// Vulkan's own minima of what gnomon can do with less of, and what they seldom are together.
constexpr const char* kLowerLimits[] = {
    "texels=65536",  // Then stages read through storage buffers,
    "texels=65536,storage_range=16777216,push_constants=128,groups=65535",
    "storage_range=1048576",  // of which a few tiles fill one.
    "storage_buffers=4",
    "crew=4",
    "crew=1",
    "timestamps=0,mapped=0",
    "dispatch_ms=1",
};

/// Of a scene at "WIDTH HEIGHT SPP SHADOW_RES LAYOUT [METHOD]".
std::string frame_hash(const std::string& environment, const std::string& scene, const std::string& settings) {
    return output_of(environment + "'" + GN_PATH(GNOMON_FRAME_HASH) + "' '" + GN_PATH(GNOMON_SOURCE_DIR) + "/scenes/" + scene +
                     ".gltf' " + settings);
}

class SameBits : public testing::TestWithParam<const char*> {
protected:
    static std::string hash(const std::string& environment) {
        return frame_hash(environment, GetParam(), "120 90 8 256 array");
    }

    /// The hash is that of `expected` at 4, 8 and 16 lanes. Another device than lavapipe does not hear of them, and gives it
    /// too.
    static void expect_at_every_width(const std::string& expected, const std::string& icd) {
        for (const int bits : {128, 256, 512}) {
            const std::string where = environment(bits, icd), used = device(where);
            if (used.find("llvmpipe") != std::string::npos) {
                EXPECT_THAT(used, testing::HasSubstr(std::to_string(bits) + " bits"));
            }
            EXPECT_EQ(hash(where), expected) << used;
        }
    }
};

TEST_P(SameBits, AtEverySubgroupSize) {
    const std::string expected = hash(environment(0, ""));
    EXPECT_THAT(expected, testing::MatchesRegex("[0-9a-f]+"));
    expect_at_every_width(expected, "");
    std::cout << device(environment(0, "")) << ": " << expected << std::endl;
}

// What a device binds at once, how it reads, what it maps and times, how long its dispatches may take: GNOMON_LIMITS lowers
// them.
TEST_P(SameBits, WithinLowerLimits) {
    const std::string expected = hash(environment(0, ""));
    EXPECT_THAT(expected, testing::MatchesRegex("[0-9a-f]+"));
    for (const char* limits : kLowerLimits) {
        EXPECT_EQ(hash(environment(0, "") + "GNOMON_LIMITS=" + limits + " "), expected) << limits;
    }
}

TEST_P(SameBits, OnTheSecondDriver) {
    const std::string icd = variable("GNOMON_SECOND_DRIVER");
    if (icd.empty()) GTEST_SKIP() << "skipped: no second driver; GNOMON_SECOND_DRIVER is not set";
    ASSERT_TRUE(std::filesystem::exists(icd)) << icd;
    EXPECT_NE(device(environment(0, icd)), device(environment(0, ""))) << "the second driver is the first";
    const std::string expected = hash(environment(0, ""));
    EXPECT_THAT(expected, testing::MatchesRegex("[0-9a-f]+"));
    EXPECT_EQ(hash(environment(0, icd)), expected);
    expect_at_every_width(expected, icd);
    std::cout << device(environment(0, icd)) << ": " << expected << std::endl;
}

class SameBitsOfMethod : public testing::TestWithParam<const char*> {};

TEST_P(SameBitsOfMethod, WithinLowerLimits) {
    const std::string settings = std::string("72 50 5 200 ") + GetParam();
    const std::string expected = frame_hash(environment(0, ""), "two-cubes", settings);
    EXPECT_THAT(expected, testing::MatchesRegex("[0-9a-f]+"));
    for (const char* limits : {"texels=65536,storage_range=2097152", "storage_range=2097152,dispatch_ms=1,mapped=0"}) {
        const std::string where = environment(0, "") + "GNOMON_LIMITS=" + limits + " ";
        EXPECT_EQ(frame_hash(where, "two-cubes", settings), expected) << limits;
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, SameBitsOfMethod,
                         testing::Values("linked exact", "array dtr", "linked dtr", "array dtr-analytic", "linked temporal",
                                         "array tsm", "array tsm-dynamic-bias", "array dsm", "array fssm", "array accumulate"),
                         [](const auto& tested) {
                             std::string name = tested.param;
                             for (char& c : name) c = c == '-' || c == ' ' ? '_' : c;
                             return name;
                         });

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, testing::Values("figure", "two-cubes", "random-cubes", "pillars"),
                         [](const auto& tested) {
                             std::string name = tested.param;
                             for (char& c : name) c = c == '-' ? '_' : c;
                             return name;
                         });

}  // namespace
}  // namespace gnomon::test
