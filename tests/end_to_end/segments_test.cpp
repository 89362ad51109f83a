// SPDX-License-Identifier: Apache-2.0
// Motion in many segments: how near it comes to a rotation, and fast triangles in all numbers of segments.
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/error.hpp>
#include <iostream>
#include <numbers>
#include <numeric>
#include <random>

#include "methods/method.hpp"
#include "shapes.hpp"

namespace gnomon::test {
namespace {

constexpr uint32_t kBlades = 5;
constexpr double kTurn = 0.5 * std::numbers::pi;  // In the shutter.
constexpr double kHeight = 1.5;                   // Of the fan over the wall behind it, across which its shadow falls.

// At rest, around the z axis.
std::array<glm::dvec2, 3> blade(uint32_t i) {
    const auto at_angle = [&](double part) {
        const double angle = 2.0 * std::numbers::pi * (i + part) / kBlades;
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    return {glm::dvec2(0.0), at_angle(0.0), at_angle(0.4)};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Is the fan, turned by its exact angle at time t, in front of this place?
bool fan_covers(const glm::dvec2& place, double t) {
    const double angle = kTurn * t;
    const glm::dvec2 p(std::cos(angle) * place.x + std::sin(angle) * place.y,
                       std::cos(angle) * place.y - std::sin(angle) * place.x);
    for (uint32_t i = 0; i < kBlades; ++i) {
        const auto [a, b, c] = blade(i);
        if (cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0) return true;
    }
    return false;
}

constexpr double kHalfHeight = 2.0;  // Of the picture, metres.

MovingTriangles fan(uint32_t segments) {
    MovingTriangles scene(segments);
    const auto z = static_cast<float>(-kHeight);
    add_quad(scene, {-5, -5, z}, {10, 0, 0}, {0, 10, 0});
    std::vector<glm::mat4> keys;
    for (uint32_t k = 0; k <= segments; ++k)
        keys.emplace_back(glm::mat4_cast(glm::angleAxis(kTurn * k / segments, glm::dvec3(0.0, 0.0, 1.0))));
    for (uint32_t i = 0; i < kBlades; ++i) {
        const auto [a, b, c] = blade(i);
        scene.add({glm::vec3(a, 0), glm::vec3(b, 0), glm::vec3(c, 0)}, keys);
    }
    scene.add(orthographic(kHalfHeight), {{glm::dvec3(0.0, 0.0, 5.0), {}}});
    scene.add(sun(), {{glm::dvec3(0.0), looking({1.0, 0.0, -1.0})}});
    return scene;
}

// Samples, and shadow tests, that are not as the exact rotation has them.
struct Wrong {
    double samples = 0.0, shadows = 0.0;
};

Wrong wrong_shares(uint32_t segments) {
    const RenderSettings settings = small_settings(160, 120, 16, 256);
    const Frame frame = sampled_frame(fan(segments), settings);
    uint64_t samples = 0, shadows = 0, on_the_wall = 0;
    for (size_t i = 0; i < frame.samples.size(); ++i) {
        const oracle::SamplePoint p = sample_at(i, settings.width, settings.spp, settings.seed);
        const double metre = 0.5 * settings.height / kHalfHeight;
        const glm::dvec2 place((p.x - 0.5 * settings.width) / metre, (0.5 * settings.height - p.y) / metre);
        const bool fan_hit = frame.samples[i].triangle != SampleRecord::kMiss && frame.samples[i].triangle >= 2;
        samples += fan_hit != fan_covers(place, p.t);
        if (fan_hit || frame.samples[i].triangle == SampleRecord::kMiss) continue;
        ++on_the_wall;
        shadows += (frame.samples[i].lit == 0) != fan_covers(place - glm::dvec2(kHeight, 0.0), p.t);
    }
    const Wrong wrong{double(samples) / double(frame.samples.size()), double(shadows) / double(on_the_wall)};
    std::cout << segments << " segments: " << 100.0 * wrong.samples << " % of samples, " << 100.0 * wrong.shadows
              << " % of shadow tests" << std::endl;
    return wrong;
}

TEST(Segments, ErrorOfATurningFanFallsWithTheirSquare) {
    std::vector<Wrong> wrong;
    for (const uint32_t segments : {1u, 4u, 16u, 128u}) wrong.push_back(wrong_shares(segments));
    for (double Wrong::*share : {&Wrong::samples, &Wrong::shadows}) {
        EXPECT_GT(wrong[0].*share, 0.02) << "too little to measure";
        for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(wrong[i].*share / wrong[i + 1].*share) / 2.0, 2.0, 0.4) << i;
        EXPECT_LT(wrong[3].*share, wrong[2].*share / 20.0);
    }
}

// Each crosses the whole picture in the shutter, in a direction of its own.
MovingTriangles crossing_triangles(uint32_t count, uint32_t segments) {
    MovingTriangles scene(segments);
    add_quad(scene, {-6, -6, -2}, {12, 0, 0}, {0, 12, 0});
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<float>(random() >> 8) * (1.0f / 16777216.0f); };
    for (uint32_t i = 0; i < count; ++i) {
        const float angle = 6.2831853f * uniform(), across = 4.0f * uniform() - 2.0f, z = 2.0f * uniform() - 1.0f;
        const glm::vec3 along(std::cos(angle), std::sin(angle), 0.0f), beside(-along.y, along.x, 0.0f);
        const glm::vec3 centre = -2.8f * along + across * beside + glm::vec3(0, 0, z);
        const auto corner = [&] { return centre + 0.06f * glm::vec3(uniform() - 0.5f, uniform() - 0.5f, uniform() - 0.5f); };
        const glm::vec3 a = corner(), b = corner(), c = corner();
        scene.add({a, b, c}, 5.6f * along);
    }
    scene.add(perspective(0.8), {at({0.0, 0.3, 5.0}, {0.0, 0.0, 0.0})});
    scene.add(sun(), {{glm::dvec3(0.0), looking({0.3, -0.2, -1.0})}});
    return scene;
}

class FastTriangles : public testing::TestWithParam<uint32_t> {};

TEST_P(FastTriangles, AgreeWithTheReferenceAtAnyBudget) {
    const PosedScene posed = crossing_triangles(10000, GetParam());
    RenderSettings settings = small_settings(96, 72, 4, 128);
    const Agreement agreement = agreement_of(posed, settings);
    std::cout << agreement << std::endl;
    EXPECT_EQ(agreement.primary_wrong, 0u) << agreement.first_wrong;
    EXPECT_EQ(agreement.shadow_wrong, 0u) << agreement.first_wrong;
    EXPECT_GE(agreement.primary_share(), 0.9999);
    EXPECT_GE(agreement.shadow_share(), 0.9998);
    EXPECT_GT(agreement.shadow_tests, agreement.samples / 2);

    settings.keep_samples = true;
    const Frame whole = shared_renderer().render(posed.scene, posed.poses, settings);
    const auto share = [&](const auto& counts) {
        return double(std::count_if(whole.samples.begin(), whole.samples.end(), counts)) / double(whole.samples.size());
    };
    EXPECT_GT(share([](const SampleRecord& r) { return r.triangle != SampleRecord::kMiss && r.triangle >= 2; }), 0.05);
    EXPECT_GT(share([](const SampleRecord& r) { return r.triangle < 2 && r.lit == 0; }), 0.02);
    settings.keep_samples = false;
    settings.memory_budget = whole.stats.peak_bytes - whole.stats.peak_bytes / 8;
    const Frame in_parts = shared_renderer().render(posed.scene, posed.poses, settings);
    EXPECT_EQ(hash_of(in_parts), hash_of(whole));
    EXPECT_LE(in_parts.stats.peak_bytes, settings.memory_budget);
}

INSTANTIATE_TEST_SUITE_P(Segments, FastTriangles, testing::Values(1, 4, 16, kMostSegments));

// Cells of time are no fewer than segments, in whatever a method keeps.
TEST(Segments, ServeEveryMethodAndAskedPages) {
    const PosedScene posed = fan(kMostSegments);
    RenderSettings settings = small_settings(64, 48, 16, 128);
    const auto lit = [&] {
        const std::vector<float> values = channel(shared_renderer().render(posed.scene, posed.poses, settings), "visibility.0");
        return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    };
    const double exact = lit();
    settings.pages = "asked";
    EXPECT_EQ(lit(), exact);
    settings.pages = "all";
    for (const Method& method : methods()) {
        settings.method = method.name;
        settings.parameters.clear();
        if (method.name == "accumulate") settings.parameters["slices"] = 16;
        EXPECT_NEAR(lit(), exact, 0.03) << method.name;
    }
}

TEST(Segments, OneMoreThanThereMayBeIsRefused) {
    const PosedScene posed = fan(kMostSegments + 1);
    EXPECT_THROW(shared_renderer().render(posed.scene, posed.poses, small_settings(8, 8, 1)), Error);
}

}  // namespace
}  // namespace gnomon::test
