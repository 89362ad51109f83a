// SPDX-License-Identifier: Apache-2.0
// Method dtr-analytic in whole frames: against method exact, in every layout.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <gnomon/render.hpp>

#include "layouts/layout.hpp"
#include "support/two_cubes.hpp"

namespace gnomon::test {
namespace {

class DtrAnalyticTest : public TwoCubes<> {
protected:
    DtrAnalyticTest() : TwoCubes(96, 64, 8) { settings.keep_samples = true; }

    Frame render(const std::string& method, uint32_t shadow_res) {
        settings.method = method;
        settings.shadow_res = shadow_res;
        return validated_renderer().render(scene, poses, settings);
    }
};

struct Difference {
    uint64_t hits = 0;
    uint64_t lost_light = 0;  ///< Shadowed, and lit in the exact frame.
    uint64_t lost_shadow = 0;

    double share() const { return static_cast<double>(lost_light + lost_shadow) / static_cast<double>(hits); }
};

Difference compare(const Frame& frame, const Frame& exact) {
    Difference d;
    EXPECT_EQ(frame.samples.size(), exact.samples.size());
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        EXPECT_EQ(frame.samples[i].triangle, exact.samples[i].triangle);
        if (exact.samples[i].triangle == SampleRecord::kMiss) continue;
        ++d.hits;
        const bool lit = (frame.samples[i].lit & 1u) != 0, right = (exact.samples[i].lit & 1u) != 0;
        d.lost_light += !lit && right ? 1 : 0;
        d.lost_shadow += lit && !right ? 1 : 0;
    }
    return d;
}

// It errs by the depth's slope over a texel, so less where texels are smaller.
TEST_F(DtrAnalyticTest, NearsTheExactMethodAsTexelsShrink) {
    const Frame exact = render("exact", 256);
    double before = 1.0;
    for (uint32_t resolution : {32u, 128u, 512u, 2048u}) {
        const Difference d = compare(render("dtr-analytic", resolution), exact);
        RecordProperty("share_" + std::to_string(resolution), std::to_string(d.share()));
        EXPECT_GT(d.hits, 1000u);
        EXPECT_LT(d.share(), 0.9 * before) << resolution;
        before = d.share();
    }
    EXPECT_GT(before, 0.0) << "texel centres cannot be exact";
}

// Faces that the light meets at right angles have one depth, whatever the texel: their neighbours do not shadow them, although
// they move toward the light.
TEST_F(DtrAnalyticTest, FacesAcrossTheLightDoNotShadowThemselves) {
    for (Pose& pose : poses) pose.lights[0].rotation = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
    std::vector<std::vector<glm::vec3>> keys;
    for (const Pose& pose : poses) keys.push_back(posed_positions(scene, pose));
    const auto is_level = [&](uint32_t triangle) {
        const auto& v = scene.triangles[triangle].vertex;
        const bool moves = keys.front()[v[0]].y < keys.back()[v[0]].y;
        return moves && std::all_of(keys.begin(), keys.end(),
                                    [&](const auto& at) { return at[v[0]].y == at[v[1]].y && at[v[1]].y == at[v[2]].y; });
    };
    const Frame exact = render("exact", 128), frame = render("dtr-analytic", 128);
    uint64_t level = 0, lost_light = 0;
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        const SampleRecord& right = exact.samples[i];
        if (right.triangle == SampleRecord::kMiss || !is_level(right.triangle) || (right.lit & 1u) == 0) continue;
        ++level;
        lost_light += (frame.samples[i].lit & 1u) == 0 ? 1 : 0;
    }
    EXPECT_GT(level, 1000u);
    EXPECT_EQ(lost_light, 0u) << "of " << level;
}

TEST_F(DtrAnalyticTest, IsTheSameInEveryLayout) {
    const Frame expected = render("dtr-analytic", 200);
    for (const std::string layout : {"array", "linked", "array-counter", "sorted-time"}) {
        settings.layout = layout;
        const Frame frame = render("dtr-analytic", 200);
        EXPECT_EQ(frame.effective.at("layout"), layout);
        ASSERT_EQ(frame.channels.size(), expected.channels.size());
        for (size_t i = 0; i < frame.channels.size(); ++i)
            EXPECT_TRUE(frame.channels[i].values == expected.channels[i].values) << layout << " " << frame.channels[i].name;
    }
}

TEST_F(DtrAnalyticTest, SaysWhatItUsed) {
    const Frame frame = render("dtr-analytic", 64);
    EXPECT_EQ(frame.effective.at("method"), "dtr-analytic");
    EXPECT_EQ(frame.effective.at("raster"), "analytic");
    EXPECT_EQ(frame.effective.at("light_cells"), "2") << "one per segment";
    EXPECT_GT(frame.stats.buffer_bytes.count("s_buffer.exits"), 0u);
    const Frame exact = render("exact", 64);
    EXPECT_EQ(exact.effective.at("raster"), "conservative");
    EXPECT_EQ(exact.stats.buffer_bytes.count("s_buffer.exits"), 0u) << "paid for, not used";
}

}  // namespace
}  // namespace gnomon::test
