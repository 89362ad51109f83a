// SPDX-License-Identifier: Apache-2.0
// Methods dtr and temporal in whole frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <gnomon/error.hpp>

#include "end_to_end/moving_triangles.hpp"
#include "layouts/layout.hpp"
#include "support/two_cubes.hpp"

namespace gnomon::test {
namespace {

class DtrTest : public TwoCubes<> {
protected:
    DtrTest() : TwoCubes(96, 64, 8) {
        settings.keep_samples = true;
        settings.shadow_res = 200;
    }
};

// Equation 2 of the paper of 2018, with a list per segment.
TEST_F(DtrTest, MemoryIsThePapersToTheByte) {
    const Frame frame = render("dtr");
    EXPECT_EQ(frame.effective.at("layout"), "linked");
    EXPECT_EQ(frame.effective.at("raster"), "prism");
    const auto& counts = frame.stats.counts;
    const uint64_t segments = poses.size() - 1, texels = uint64_t(200) * 200 * segments;
    const uint64_t paper = counts.at("fragments.0") * 16 + counts.at("ranges.0") * 24 + 2 * texels * 4;
    uint64_t allocated = 0;
    for (const char* name : {"fragment_heads", "fragments", "heads", "ranges", "links", "exits"})
        allocated += frame.stats.buffer_bytes.at(std::string("s_buffer.") + name);
    EXPECT_EQ(allocated, paper);
    EXPECT_EQ(counts.at("map_bytes.0"), paper);
    EXPECT_EQ(counts.at("fragments_left_over.0"), 0u);
    EXPECT_EQ(counts.at("ranges.0") * 2, counts.at("fragments.0"));
}

// The cubes' sides are planar: they only translate.
TEST_F(DtrTest, IsDtrAnalyticWhereSidesArePlanar) {
    const Frame prism = render("dtr"), analytic = render("dtr-analytic");
    EXPECT_EQ(prism.stats.counts.at("ranges.0"), analytic.stats.counts.at("ranges.0"));
    EXPECT_LE(differing(prism, analytic), 2e-4);
}

// The share of wrong samples of cubes that move toward the light, all with the bias that surfaces at rest need.
TEST_F(DtrTest, DoesNotShadowWhatMovesTowardTheLight) {
    settings.shadow_res = 2048;
    const Frame exact = render("exact");
    settings.parameters["bias"] = 0.1;
    std::map<std::string, double> wrong;
    for (const char* method : {"tsm", "dtr", "dtr-analytic", "temporal"}) {
        wrong[method] = differing(render(method), exact);
        RecordProperty(method, std::to_string(wrong[method]));
    }
    EXPECT_GT(wrong["tsm"], 0.01);
    EXPECT_LT(wrong["dtr"], wrong["tsm"] / 3.0);
    EXPECT_LT(wrong["dtr-analytic"], wrong["tsm"] / 3.0);
    // What covers a texel at its centre shadows its neighbours in the same texel, without regard to depth.
    EXPECT_GT(wrong["temporal"], wrong["dtr"]);
    EXPECT_LT(wrong["temporal"], 0.05);
}

TEST_F(DtrTest, MemoryAndLayoutsDoNotMatter) {
    settings.shadow_res = 400;
    for (const char* method : {"dtr", "temporal"}) {
        settings.memory_budget = 0;
        settings.layout = "auto";
        const Frame expected = render(method);
        for (const char* layout : {"array", "linked", "paged", "jagged", "sorted-depth"}) {
            settings.layout = layout;
            expect_same_bits(render(method), expected);
        }
        settings.layout = "auto";
        settings.memory_budget = 16u << 20;
        const Frame cut = render(method);
        expect_same_bits(cut, expected);
        if (std::string_view(method) == "dtr") {
            EXPECT_LT(cut.stats.buffer_bytes.at("s_buffer.fragments"), expected.stats.buffer_bytes.at("s_buffer.fragments"))
                << "no bands";
        }
    }
}

TEST_F(DtrTest, CoverageMapSavesRangesAndChangesLittle) {
    const Frame dtr = render("dtr"), temporal = render("temporal");
    const auto &with = temporal.stats.counts, &without = dtr.stats.counts;
    RecordProperty("ranges", std::to_string(without.at("ranges.0")) + " -> " + std::to_string(with.at("ranges.0")));
    EXPECT_GT(with.at("covered_texels.0"), 1000u);
    EXPECT_LT(with.at("ranges.0"), without.at("ranges.0") / 2);
    const double changed = differing(dtr, temporal);
    RecordProperty("changed", std::to_string(changed));
    EXPECT_LT(changed, 0.1);
    EXPECT_GT(changed, 0.0) << "texels are covered where their centres are";
}

// Of a closed mesh about half is seen from behind.
TEST_F(DtrTest, BackFacesCanBeLeftOut) {
    const uint64_t all = render("dtr").stats.counts.at("ranges.0");
    settings.parameters["cull-back-faces"] = 1;
    const uint64_t front = render("dtr").stats.counts.at("ranges.0");
    EXPECT_LT(front, all);
    EXPECT_GT(front, all / 4);
    settings.raster = "analytic";
    EXPECT_THROW(render("dtr"), Error);
}

// Under a roof at rest: its triangle covers every texel in which it is, and what is below is dark without a range being asked.
TEST(TemporalTest, WhatIsCoveredIsDarkWithoutRanges) {
    MovingTriangles scene(1);
    scene.add({glm::vec3(-20, 5, -20), {20, 5, -20}, {0, 5, 40}});
    const uint32_t floor = scene.add({glm::vec3(-9, 0, -4), {9, 0, -4}, {0, 0, 9}}, glm::vec3(1, 0, 0));
    const glm::dquat down = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
    Camera camera;
    camera.kind = CameraKind::orthographic;
    camera.xmag = camera.ymag = 1.0;
    scene.add(camera, {{glm::dvec3(0, 3, 0), down}});
    scene.add(Light{}, {{glm::dvec3(0, 12, 0), down}});
    RenderSettings settings;
    settings.width = settings.height = 24;
    settings.spp = 4;
    settings.shadow_res = 64;
    settings.keep_samples = settings.count_ranges = true;
    settings.method = "temporal";
    Renderer renderer("", true);
    const Frame frame = renderer.render(scene.scene, scene.poses, settings);
    for (const SampleRecord& s : frame.samples) {
        EXPECT_EQ(s.triangle, floor);
        EXPECT_EQ(s.lit & 1u, 0u);
    }
    EXPECT_EQ(frame.stats.counts.at("ranges_visited"), 0u);
    // Seen from above, the roof is what the light reaches.
    for (Pose& pose : scene.poses) pose.cameras[0].translation.y = 10.0;
    for (const SampleRecord& s : renderer.render(scene.scene, scene.poses, settings).samples) {
        EXPECT_NE(s.triangle, floor);
        EXPECT_EQ(s.lit & 1u, 1u);
    }
}

}  // namespace
}  // namespace gnomon::test
