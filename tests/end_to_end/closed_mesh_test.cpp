// SPDX-License-Identifier: Apache-2.0
// Closed meshes do not shade their own lit side, and no light leaks through them.
#include <gtest/gtest.h>

#include <iostream>

#include "scenes/scene_makers.hpp"
#include "shapes.hpp"

namespace gnomon::test {
namespace {

using Verdict = oracle::SampleJudge::Verdict;

// Cosine between the triangle's outward normal and the direction to the light, at a sample's hit.
double facing(const oracle::SampleJudge& judge, uint32_t triangle, uint32_t light, const oracle::SamplePoint& p) {
    return glm::dot(judge.normal(triangle, p.t), glm::normalize(judge.toward_light(light, judge.hit_point(triangle, p), p.t)));
}

struct SphereCase {
    bool spot;
    bool fast;
    uint32_t shadow_res;
};

void PrintTo(const SphereCase& c, std::ostream* out) {
    *out << (c.spot ? "spot" : "sun") << (c.fast ? "_fast_" : "_still_") << c.shadow_res;
}

class ClosedSphere : public testing::TestWithParam<SphereCase> {};

// The mesh is convex: nothing else is in the way of what faces the light, and its own other side hides what does not.
TEST_P(ClosedSphere, IsLitWhereItFacesTheLightAndNowhereElse) {
    const auto [is_spot, fast, shadow_res] = GetParam();
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.4, 1.0, 0.6));
    MovingTriangles scene(1);
    add_sphere(scene, {0.1f, -0.2f, 0.05f}, 1.0f, 24, fast ? glm::vec3(1.6 * to_light) : glm::vec3(0.0f));
    scene.add(orthographic(1.8), {at({0.5, 0.6, 8.0}, {0.5, 0.6, 0.0})});
    scene.add(is_spot ? spot(0.6f) : sun(), {at(7.0 * to_light, glm::dvec3(0.0))});
    const RenderSettings settings = small_settings(96, 96, 8, shadow_res);
    const Frame frame = sampled_frame(scene, settings);
    const oracle::SampleJudge judge(scene.scene, scene.poses, 0, settings.width, settings.height);
    uint64_t facing_light = 0, dark_there = 0, averted = 0, lit_there = 0, leaks = 0;
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        const SampleRecord& record = frame.samples[i];
        if (record.triangle == SampleRecord::kMiss) continue;
        const oracle::SamplePoint p = sample_at(i, settings.width, settings.spp, settings.seed);
        if (facing(judge, record.triangle, 0, p) > 0.0) {
            ++facing_light;
            dark_there += record.lit == 0;
        } else {
            ++averted;
            lit_there += record.lit != 0;
            // Beside the terminator the mesh is thinner than the tolerance.
            leaks += record.lit != 0 && judge.shadow(record.triangle, 0, true, p) == Verdict::wrong;
        }
    }
    std::cout << facing_light << " samples face the light, dark " << dark_there << "; " << averted
              << " do not, lit within the tolerance " << lit_there - leaks << ", leaks " << leaks << std::endl;
    EXPECT_GT(facing_light, 5000u);
    EXPECT_GT(averted, 2000u);
    EXPECT_EQ(dark_there, 0u);
    EXPECT_EQ(leaks, 0u);
    EXPECT_LE(lit_there, averted / 200);
}

INSTANTIATE_TEST_SUITE_P(All, ClosedSphere, testing::ValuesIn([] {
                             std::vector<SphereCase> cases;
                             for (const bool is_spot : {false, true}) {
                                 for (const bool fast : {false, true}) {
                                     for (const uint32_t res : {16u, 128u, 1024u}) cases.push_back({is_spot, fast, res});
                                 }
                             }
                             return cases;
                         }()),
                         [](const auto& tested) { return testing::PrintToString(tested.param); });

// The scene that time-dependent shadow maps shade with its own shadow.
TEST(TwoCubes, NoLitSideIsInItsOwnShadow) {
    const PosedScene posed = load_posed(made_file("two_cubes", [](const auto& path) { makers::make_two_cubes(path, {6000}); }));
    RenderSettings settings = small_settings(240, 180, 4);
    const oracle::SampleJudge judge(posed.scene, posed.poses, 0, settings.width, settings.height);
    const Frame truth = reference_frame(posed, settings);
    for (const uint32_t shadow_res : {32u, 128u, 1024u}) {
        settings.shadow_res = shadow_res;
        const Frame frame = sampled_frame(posed, settings);
        uint64_t lit_sides = 0, wrong = 0;
        for (size_t i = 0; i < frame.samples.size(); ++i) {
            const SampleRecord& record = frame.samples[i];
            // The other cube's shadow: the reference, which is tested against brute force, is dark there too.
            if (record.triangle == SampleRecord::kMiss || record.triangle != truth.samples[i].triangle ||
                truth.samples[i].lit == 0)
                continue;
            const oracle::SamplePoint p = sample_at(i, settings.width, settings.spp, settings.seed);
            if (facing(judge, record.triangle, 0, p) <= 0.0) continue;
            ++lit_sides;
            wrong += record.lit == 0;
        }
        std::cout << "shadow_res " << shadow_res << ": " << lit_sides << " samples on lit sides, dark " << wrong << std::endl;
        EXPECT_GT(lit_sides, frame.samples.size() / 4);
        EXPECT_EQ(wrong, 0u) << shadow_res;
    }
}

}  // namespace
}  // namespace gnomon::test
