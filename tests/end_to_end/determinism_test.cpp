// SPDX-License-Identifier: Apache-2.0
// The picture depends on the scene and the samples only: not on threads, layout, memory or how the work was cut up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <gnomon/error.hpp>
#include <iostream>

#include "io/image_hash.hpp"
#include "methods/method.hpp"
#include "scenes/scene_makers.hpp"
#include "shapes.hpp"
#include "support/paths.hpp"

namespace gnomon::test {
namespace {

std::filesystem::path small_figure() {
    return made_file("figure_2000", [](const auto& path) { makers::make_figure(path, {2000, true}); });
}

// Stages that ran more often when the work was cut up.
uint64_t dispatches(const Frame& frame, const std::string& stage) {
    for (const FrameStats::Stage& s : frame.stats.stages) {
        if (s.name == stage) return s.dispatches;
    }
    return 0;
}

TEST(Determinism, SameBitsTwice) {
    const PosedScene posed = load_posed(small_figure());
    const RenderSettings settings = small_settings(90, 70, 16);
    const uint64_t first = hash_of(shared_renderer().render(posed.scene, posed.poses, settings));
    EXPECT_EQ(first, hash_of(shared_renderer().render(posed.scene, posed.poses, settings)));
    EXPECT_EQ(first, hash_of(Renderer().render(posed.scene, posed.poses, settings)));
    RenderSettings other = settings;
    other.seed = 1;
    EXPECT_NE(first, hash_of(shared_renderer().render(posed.scene, posed.poses, other)));
}

TEST(Determinism, SameBitsWithKeptSamples) {
    const PosedScene posed = load_posed(small_figure());
    const RenderSettings settings = small_settings(90, 70, 7);
    EXPECT_EQ(hash_of(sampled_frame(posed, settings)), hash_of(shared_renderer().render(posed.scene, posed.poses, settings)));
}

std::string hash_of_child(const std::string& environment, const std::string& layout) {
    const std::string command =
        environment + " '" + GN_PATH(GNOMON_FRAME_HASH) + "' '" + small_figure().string() + "' 90 70 16 256 " + layout;
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return "popen failed";
    std::string text;
    for (char buffer[256]; std::fgets(buffer, sizeof buffer, pipe) != nullptr;) text += buffer;
    return pclose(pipe) == 0 ? text : "failed: " + text;
}

TEST(Determinism, SameBitsWithAnyNumberOfThreadsAndEveryLayout) {
    const PosedScene posed = load_posed(small_figure());
    const std::string expected =
        io::hash_text(hash_of(shared_renderer().render(posed.scene, posed.poses, small_settings(90, 70, 16))));
    // LP_NUM_THREADS is lavapipe's; another driver ignores it and must give the same bits in another process all the more.
    for (const char* threads : {"LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2", "LP_NUM_THREADS=5"}) {
        EXPECT_EQ(hash_of_child(threads, "array"), expected) << threads;
    }
    for (const char* threads : {"LP_NUM_THREADS=1", "LP_NUM_THREADS=2"})
        EXPECT_EQ(hash_of_child(threads, "linked"), expected) << threads;
}

TEST(Determinism, FramesOfALoadedSceneOverUsedOnes) {
    MovingTriangles two = still_life(1);
    two.add(spot(0.5f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    const PosedScene one = still_life(2);
    const LoadedScene loaded_two = shared_renderer().load(two.scene), loaded_one = shared_renderer().load(one.scene);
    Frame frame;
    for (const auto& [width, height, method] : {std::tuple{120u, 90u, "exact"}, {64u, 48u, "fssm"}, {64u, 48u, "tsm"}}) {
        RenderSettings settings = small_settings(width, height, 4);
        settings.method = method;
        settings.keep_samples = width == 120;
        shared_renderer().render(loaded_two, two.poses, settings, frame);
        const Frame fresh = shared_renderer().render(two.scene, two.poses, settings);
        EXPECT_EQ(hash_of(frame), hash_of(fresh));
        EXPECT_EQ(frame.samples.size(), fresh.samples.size());
        EXPECT_EQ(frame.stats.counts, fresh.stats.counts);
        shared_renderer().render(loaded_one, one.poses, settings, frame);
        EXPECT_EQ(hash_of(frame), hash_of(shared_renderer().render(one.scene, one.poses, settings)));
        EXPECT_EQ(frame.channels.size(), 7u);
    }
}

// What was not rendered yet is zero, whatever was there.
TEST(Determinism, AStoppedFrameKeepsNothingOfTheOneBefore) {
    const PosedScene posed = still_life(1);
    RenderSettings settings = small_settings(200, 160, 4);
    settings.memory_budget = 6u << 20;
    const LoadedScene loaded = shared_renderer().load(posed.scene);
    Frame frame;
    uint32_t calls = 0;
    shared_renderer().render(loaded, posed.poses, settings, frame, [&](double) { return ++calls > 0; });
    ASSERT_GT(calls, 2u);
    const Frame whole = frame;
    for (Channel& known : frame.channels) std::ranges::fill(known.values, 7.0f);
    calls = 0;
    shared_renderer().render(loaded, posed.poses, settings, frame, [&](double share) { return share == 1.0 || ++calls < 2; });
    for (const Channel& got : frame.channels) EXPECT_EQ(std::ranges::count(got.values, 7.0f), 0) << got.name;
    EXPECT_NE(hash_of(frame), hash_of(whole));
}

class Budget : public testing::TestWithParam<const char*> {};

// Smaller and smaller budgets, until it is an error: the same picture in more and more bands and batches.
TEST_P(Budget, PictureDoesNotDependOnIt) {
    const PosedScene posed = load_posed(made_file("figure", [](const auto& path) { makers::make_figure(path); }));
    RenderSettings settings = small_settings(128, 96, 16, 512);
    settings.layout = GetParam();
    const Frame whole = shared_renderer().render(posed.scene, posed.poses, settings);
    uint64_t enough = whole.stats.peak_bytes, too_small = 0;
    uint64_t most_fills = 0, most_batches = 0;
    std::string message;
    for (int i = 0; i < 8; ++i) {
        settings.memory_budget = (enough + too_small) / 2;
        try {
            const Frame frame = shared_renderer().render(posed.scene, posed.poses, settings);
            EXPECT_EQ(hash_of(frame), hash_of(whole)) << settings.memory_budget;
            EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
            most_fills = std::max(most_fills, dispatches(frame, "raster/fill"));
            most_batches = std::max(most_batches, dispatches(frame, "sample/trace"));
            enough = settings.memory_budget;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::out_of_memory) << error.what();
            message = error.what();
            too_small = settings.memory_budget;
        }
    }
    std::cout << "unlimited: " << whole.stats.peak_bytes << " bytes, " << dispatches(whole, "raster/fill") << " fills, "
              << dispatches(whole, "sample/trace") << " batches; least that works: " << enough << " bytes, " << most_fills
              << " fills, " << most_batches << " batches; below: " << message << std::endl;
    EXPECT_GT(most_fills, 2 * dispatches(whole, "raster/fill"));
    EXPECT_GT(most_batches, 2 * dispatches(whole, "sample/trace"));
    EXPECT_LT(enough, whole.stats.peak_bytes);
    EXPECT_THAT(message, testing::HasSubstr("--memory-budget"));
}

INSTANTIATE_TEST_SUITE_P(Layouts, Budget, testing::Values("array", "linked"),
                         [](const auto& tested) { return std::string(tested.param); });

// Every method, with less and less room: maps in windows and bands, films in parts, few samples at a time.
TEST(Budget, HoldsForEveryMethod) {
    MovingTriangles scene = still_life(2);
    scene.add(spot(0.6f, 0.3f, 20.0f), {at({2.0, 5.0, 1.0}, {0.0, 0.5, 0.0})});
    const PosedScene posed = scene;
    for (const Method& method : methods()) {
        SCOPED_TRACE(method.name);
        RenderSettings settings = small_settings(72, 50, 6, 200);
        settings.method = method.name;
        if (method.name == "accumulate") settings.parameters["slices"] = 12;
        const Frame whole = shared_renderer().render(posed.scene, posed.poses, settings);
        for (const uint64_t mebibytes : {16u, 7u, 5u}) {
            if (!method.windowed && mebibytes < 16) continue;
            settings.memory_budget = mebibytes << 20;
            const Frame frame = shared_renderer().render(posed.scene, posed.poses, settings);
            EXPECT_EQ(hash_of(frame), hash_of(whole)) << mebibytes << " MiB";
            EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
        }
    }
}

// More lights than there is room for: each is made when it is tested.
TEST(Budget, HoldsForManyLights) {
    MovingTriangles scene = still_life(1);
    for (int i = 1; i < 32; ++i) scene.add(sun(0.3f), {{glm::dvec3(0.0), looking({0.1 * i - 1.6, -1.0, 0.3})}});
    const PosedScene posed = scene;
    RenderSettings settings = small_settings(72, 50, 6, 160);
    const Frame whole = shared_renderer().render(posed.scene, posed.poses, settings);
    settings.memory_budget = 6u << 20;
    ASSERT_GT(whole.stats.peak_bytes, 4 * settings.memory_budget);
    const Frame frame = shared_renderer().render(posed.scene, posed.poses, settings);
    EXPECT_EQ(hash_of(frame), hash_of(whole));
    EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
    for (const char* count : {"ranges.0", "ranges.31", "bin_entries.7"})
        EXPECT_EQ(frame.stats.counts.at(count), whole.stats.counts.at(count)) << count;
}

/// Bytes of the budget that a refusal names; 0 where it names none.
uint64_t named_budget(const std::string& message) {
    const std::string before = "use --memory-budget ";
    const size_t at = message.find(before);
    return at == std::string::npos ? 0 : std::stoull(message.substr(at + before.size())) << 20;
}

/// The budget that the refusal names; 0 where the picture is that of the hash.
uint64_t refused(const PosedScene& posed, const RenderSettings& settings, uint64_t expected) {
    try {
        const Frame frame = shared_renderer().render(posed.scene, posed.poses, settings);
        EXPECT_EQ(hash_of(frame), expected) << settings.memory_budget;
        EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
        return 0;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::out_of_memory);
        const uint64_t named = named_budget(error.what());
        EXPECT_GT(named, settings.memory_budget) << error.what();
        return named;
    }
}

// What is refused says what would do, and that does: of a scene whose own data is too much, and of ranges and layers so dense
// that not even a tile's have room beside them.
TEST(Budget, WhatIsNamedIsEnough) {
    const PosedScene posed = load_posed(made_file("figure_40000", [](const auto& path) {
        makers::make_figure(path, {40000, true});
    }));
    RenderSettings settings = small_settings(64, 48, 4, 64);
    settings.pages = "all";          // What hits ask for is less, and fits;
    settings.closed_meshes = false;  // so is what a fitted view lists.
    int refusals = 0;
    for (const char* method : {"exact", "dtr", "temporal", "tsm", "fssm"}) {
        settings.method = method;
        settings.memory_budget = 0;
        const uint64_t expected = hash_of(shared_renderer().render(posed.scene, posed.poses, settings));
        settings.memory_budget = 1u << 20;
        const uint64_t least = refused(posed, settings, expected);
        for (const double times : {1.0, 1.05, 1.2, 1.5, 2.0, 3.0}) {
            SCOPED_TRACE(method + std::string(" at ") + std::to_string(times));
            settings.memory_budget = static_cast<uint64_t>(static_cast<double>(least) * times);
            const uint64_t named = refused(posed, settings, expected);
            if (named == 0) continue;
            ++refusals;
            settings.memory_budget = named;
            EXPECT_EQ(refused(posed, settings, expected), 0u);
        }
    }
    std::cout << refusals << " refusals" << std::endl;
    EXPECT_GT(refusals, 1);
}

// Offsets of all lists of a view, in several cells of time, may take more than one binding holds.
TEST(Budget, ListsOfManyTexelsAndSegments) {
    const MovingTriangles scene = still_life(3);
    const RenderSettings settings = small_settings(32, 24, 4, 4096);
    const Agreement agreement = agreement_of(scene, settings);
    EXPECT_EQ(agreement.primary_wrong + agreement.shadow_wrong, 0u) << agreement;
    EXPECT_GT(agreement.shadow_tests, 0u);
}

struct Size {
    uint32_t width, height;
};

class ImageSize : public testing::TestWithParam<Size> {};

TEST_P(ImageSize, AgreesWithTheReference) {
    const MovingTriangles scene = still_life(1);
    const Agreement agreement = agreement_of(scene, small_settings(GetParam().width, GetParam().height, 9));
    EXPECT_EQ(agreement.samples, uint64_t{GetParam().width} * GetParam().height * 9);
    EXPECT_EQ(agreement.primary_wrong + agreement.shadow_wrong, 0u) << agreement;
    EXPECT_LE(agreement.primary_differ + agreement.shadow_differ, 1 + agreement.samples / 5000) << agreement;
}

INSTANTIATE_TEST_SUITE_P(All, ImageSize,
                         testing::Values(Size{1, 1}, Size{1, 37}, Size{37, 1}, Size{7, 9}, Size{8, 8}, Size{9, 7}, Size{63, 17},
                                         Size{65, 33}, Size{257, 3}),
                         [](const auto& tested) {
                             return std::to_string(tested.param.width) + "x" + std::to_string(tested.param.height);
                         });

struct Strata {
    uint32_t spp, segments;
};

class Samples : public testing::TestWithParam<Strata> {};

// Strata lie in one cell of time or straddle several; a cell of time lies in one segment.
TEST_P(Samples, AgreeWithTheReference) {
    const PosedScene posed = load_posed(small_figure(), {"0", GetParam().segments});
    const Agreement agreement = agreement_of(posed, small_settings(42, 30, GetParam().spp));
    EXPECT_EQ(agreement.primary_wrong + agreement.shadow_wrong, 0u) << agreement;
    EXPECT_LE(agreement.primary_differ, 1 + agreement.samples / 5000) << agreement;
    EXPECT_LE(agreement.shadow_differ, 1 + agreement.shadow_tests / 2500) << agreement;
}

INSTANTIATE_TEST_SUITE_P(All, Samples, testing::ValuesIn([] {
                             std::vector<Strata> cases;
                             for (const uint32_t spp : {1u, 2u, 3u, 5u, 7u, 16u, 17u, 20u, 64u, 100u}) {
                                 for (const uint32_t segments : {1u, 2u, 3u}) cases.push_back({spp, segments});
                             }
                             return cases;
                         }()),
                         [](const auto& tested) {
                             return "spp_" + std::to_string(tested.param.spp) + "_segments_" +
                                    std::to_string(tested.param.segments);
                         });

}  // namespace
}  // namespace gnomon::test
