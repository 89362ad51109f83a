// SPDX-License-Identifier: Apache-2.0
// The Embree reference against the brute-force oracle, on random moving triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/error.hpp>
#include <random>

#include "math/sample.h"
#include "moving_triangles.hpp"
#include "oracle/brute_force.hpp"
#include "reference.hpp"

namespace gnomon {
namespace {

using test::MovingTriangles;

class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    glm::dvec3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
    glm::dquat rotation() {
        return glm::normalize(glm::dquat(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0)));
    }
    // A small turn and step away from `from`.
    Rigid near(const Rigid& from, double step) {
        const glm::dquat turn = glm::normalize(glm::dquat(1.0, vector(step)));
        return {from.translation + vector(step), turn * from.rotation};
    }

private:
    std::mt19937 engine_;
};

// A rotation that takes -Z to `direction`.
glm::dquat facing(const glm::dvec3& direction) { return glm::quatLookAt(glm::normalize(direction), glm::dvec3(0.0, 1.0, 0.0)); }

constexpr uint32_t kSegments = 3;

std::vector<Rigid> wandering(Random& random, const Rigid& from, double step) {
    std::vector<Rigid> keys{from};
    for (uint32_t k = 0; k < kSegments; ++k) {
        keys.push_back(random.near(keys.back(), step));
        keys.back().rotation *= -1.0;  // The same rotation, but the longer way round in numbers.
    }
    return keys;
}

// Triangles in a box of side 2 that move, turn and shear; a moving camera, a turning sun, a wandering spot, a point light.
MovingTriangles random_soup(uint32_t seed, CameraKind camera_kind, uint32_t triangle_count) {
    Random random(seed);
    MovingTriangles soup(kSegments);
    for (uint32_t i = 0; i < triangle_count; ++i) {
        const test::Corners corners{random.vector(0.8), random.vector(0.8), random.vector(0.8)};
        glm::dvec3 place = random.vector(1.0);
        std::vector<glm::mat4> keys;
        for (uint32_t k = 0; k <= kSegments; ++k) {
            glm::dmat4 matrix(1.0);
            for (glm::length_t c = 0; c < 3; ++c) matrix[c] += glm::dvec4(random.vector(0.3), 0.0);
            matrix[3] = glm::dvec4(place, 1.0);
            keys.emplace_back(matrix);
            place += random.vector(0.3);
        }
        soup.add(corners, keys);
    }
    Camera camera;
    camera.kind = camera_kind;
    camera.yfov = 0.7;
    camera.ymag = 1.1;
    camera.znear = 1.5;  // Cuts through the triangles, as does zfar.
    camera.zfar = 4.0;
    soup.add(camera, wandering(random, {{0.0, 0.0, 3.0}, {1.0, 0.0, 0.0, 0.0}}, 0.15));
    soup.add(Light{}, wandering(random, {{0.0, 0.0, 0.0}, facing({0.4, -1.0, -0.5})}, 0.2));
    Light spot;
    spot.kind = LightKind::spot;
    spot.outer_cone = 0.5f;
    soup.add(spot, wandering(random, {{1.2, 1.5, 1.0}, facing({-1.0, -1.3, -0.9})}, 0.2));
    Light point;
    point.kind = LightKind::point;
    soup.add(point, wandering(random, {}, 0.1));
    return soup;
}

RenderSettings oracle_settings(const ReferenceSettings& settings) {
    RenderSettings result;
    result.width = settings.width;
    result.height = settings.height;
    result.spp = settings.spp;
    result.seed = settings.seed;
    result.camera = settings.camera;
    return result;
}

ReferenceSettings small_frame() {
    ReferenceSettings settings;
    settings.width = 45;  // No multiple of a tile or a packet.
    settings.height = 35;
    settings.spp = 6;
    settings.seed = 7;
    settings.threads = 2;
    settings.keep_samples = true;
    return settings;
}

bool same_answer(const SampleRecord& a, const SampleRecord& b) { return a.triangle == b.triangle && a.lit == b.lit; }

// Is there a sample this near for which the oracle answers the same? Rays in float miss by about 1e-5 pixels here.
bool nearby_answer(const oracle::BruteForce& oracle, const glm::vec3& p, const SampleRecord& record) {
    constexpr double kPixels = 2e-4, kTime = 1e-6;
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 direction = glm::ivec3(i, i / 3, i / 9) % 3 - 1;
        const glm::dvec3 q = glm::dvec3(p) + glm::dvec3(direction) * glm::dvec3(kPixels, kPixels, kTime);
        if (same_answer(oracle.sample(q.x, q.y, q.z), record)) return true;
    }
    return false;
}

struct Mismatches {
    uint32_t count = 0;
    uint32_t unexplained = 0;  // Those that no sample nearby explains.
};

Mismatches mismatches(const Frame& frame, const Frame& truth, const MovingTriangles& soup, const ReferenceSettings& settings) {
    const oracle::BruteForce oracle(soup.scene, soup.poses, settings.camera, settings.width, settings.height);
    Mismatches result;
    for (size_t i = 0; i < truth.samples.size(); ++i) {
        if (same_answer(frame.samples[i], truth.samples[i])) continue;
        ++result.count;
        const auto pixel = static_cast<uint32_t>(i / settings.spp), s = static_cast<uint32_t>(i % settings.spp);
        const uint32_t x = pixel % settings.width, y = pixel / settings.width;
        const glm::vec3 p =
            shared::sample_point(shared::pixel_hash(x, y, settings.seed), x, y, s, shared::stratum_length(settings.spp));
        if (!nearby_answer(oracle, p, frame.samples[i])) ++result.unexplained;
    }
    return result;
}

struct SoupCase {
    uint32_t seed;
    CameraKind camera;
};

class ReferenceSoup : public testing::TestWithParam<SoupCase> {};

TEST_P(ReferenceSoup, HitsAndShadowsAreThoseOfTheOracle) {
    const MovingTriangles soup = random_soup(GetParam().seed, GetParam().camera, 70);
    ReferenceSettings settings = small_frame();
    const Frame truth = oracle::brute_force_trace(soup.scene, soup.poses, oracle_settings(settings));
    for (const bool exact : {true, false}) {
        for (const uint32_t embree_segments : {1u, 8u}) {
            SCOPED_TRACE(testing::Message() << "exact " << exact << ", Embree segments " << embree_segments);
            settings.exact = exact;
            settings.embree_segments = embree_segments;
            const Frame frame = trace_reference(soup.scene, soup.poses, settings);
            ASSERT_EQ(frame.samples.size(), truth.samples.size());
            const Mismatches wrong = mismatches(frame, truth, soup, settings);
            EXPECT_EQ(wrong.unexplained, 0u);
            EXPECT_LE(wrong.count, truth.samples.size() / 1000);
            for (size_t i = 0; i < truth.samples.size(); ++i) {
                if (!same_answer(frame.samples[i], truth.samples[i])) continue;
                EXPECT_NEAR(frame.samples[i].depth, truth.samples[i].depth, exact ? 5e-7 : 1e-4) << "sample " << i;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ReferenceSoup,
                         testing::Values(SoupCase{1, CameraKind::perspective}, SoupCase{2, CameraKind::perspective},
                                         SoupCase{3, CameraKind::orthographic}, SoupCase{4, CameraKind::orthographic}),
                         [](const auto& tested) { return "seed_" + std::to_string(tested.param.seed); });

TEST(Reference, SoupTestsWhatItShould) {
    const MovingTriangles soup = random_soup(1, CameraKind::perspective, 70);
    const Frame truth = oracle::brute_force_trace(soup.scene, soup.poses, oracle_settings(small_frame()));
    size_t hits = 0, in_sun = 0, in_spot = 0, at_point = 0;
    for (const SampleRecord& record : truth.samples) {
        hits += record.triangle != SampleRecord::kMiss;
        in_sun += record.lit & 1u;
        in_spot += record.lit >> 1 & 1u;
        at_point += record.lit >> 2 & 1u;
    }
    EXPECT_GT(hits, truth.samples.size() / 3);
    EXPECT_LT(hits, truth.samples.size());
    EXPECT_GT(in_sun, hits / 8);
    EXPECT_LT(in_sun, hits - hits / 8);
    EXPECT_GT(in_spot, hits / 8);
    EXPECT_LT(in_spot, hits - hits / 8);
    EXPECT_GT(at_point, hits / 8);
    EXPECT_LT(at_point, hits - hits / 8);
}

TEST(Reference, ChannelsAreThoseOfTheOracle) {
    const MovingTriangles soup = random_soup(5, CameraKind::perspective, 30);
    const ReferenceSettings settings = small_frame();
    const Frame truth = oracle::brute_force_trace(soup.scene, soup.poses, oracle_settings(settings));
    const Frame frame = trace_reference(soup.scene, soup.poses, settings);
    std::vector<std::string> names;
    for (const Channel& channel : frame.channels) names.push_back(channel.name);
    EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "Z", "visibility.0", "visibility_var.0", "visibility.1",
                                               "visibility_var.1", "visibility.2", "visibility_var.2"}));
    for (const Channel& expected : truth.channels) {
        const auto channel = std::find_if(frame.channels.begin(), frame.channels.end(),
                                          [&](const Channel& c) { return c.name == expected.name; });
        ASSERT_NE(channel, frame.channels.end()) << expected.name;
        ASSERT_EQ(channel->values.size(), expected.values.size());
        size_t different = 0;
        for (size_t i = 0; i < expected.values.size(); ++i)
            different += std::abs(channel->values[i] - expected.values[i]) > 1e-5f;
        EXPECT_LE(different, expected.values.size() / 200) << expected.name;
    }
}

TEST(Reference, DoesNotDependOnThreads) {
    const MovingTriangles soup = random_soup(6, CameraKind::perspective, 70);
    ReferenceSettings settings = small_frame();
    settings.threads = 1;
    const Frame one = trace_reference(soup.scene, soup.poses, settings);
    settings.threads = 5;
    const Frame five = trace_reference(soup.scene, soup.poses, settings);
    ASSERT_EQ(one.channels.size(), five.channels.size());
    for (size_t i = 0; i < one.channels.size(); ++i) EXPECT_EQ(one.channels[i].values, five.channels[i].values);
}

TEST(Reference, FastModeHasNoColourAndKeepsNoSamples) {
    const MovingTriangles soup = random_soup(6, CameraKind::perspective, 10);
    ReferenceSettings settings = small_frame();
    settings.exact = false;
    settings.keep_samples = false;
    const Frame frame = trace_reference(soup.scene, soup.poses, settings);
    ASSERT_FALSE(frame.channels.empty());
    EXPECT_EQ(frame.channels[0].name, "A");
    EXPECT_TRUE(frame.samples.empty());
}

TEST(Reference, NoTrianglesNoHits) {
    const MovingTriangles soup = random_soup(1, CameraKind::perspective, 0);
    const Frame frame = trace_reference(soup.scene, soup.poses, small_frame());
    for (const SampleRecord& record : frame.samples) ASSERT_EQ(record.triangle, SampleRecord::kMiss);
}

TEST(Reference, WrongSettingsAreErrors) {
    const MovingTriangles soup = random_soup(1, CameraKind::perspective, 1);
    const auto kind_of = [&](const std::vector<Pose>& poses, auto&& change) {
        ReferenceSettings settings = small_frame();
        change(settings);
        try {
            trace_reference(soup.scene, poses, settings);
        } catch (const Error& error) {
            return error.kind();
        }
        return ErrorKind::internal;
    };
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.width = 0; }), ErrorKind::usage);
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.height = 16385; }), ErrorKind::usage);
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.spp = 0; }), ErrorKind::usage);
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.camera = 1; }), ErrorKind::usage);
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.threads = 1025; }), ErrorKind::usage);
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.embree_segments = 0; }), ErrorKind::usage);
    EXPECT_EQ(kind_of(soup.poses, [](auto& s) { s.embree_segments = 128; }), ErrorKind::usage);  // 129 with three segments.
    EXPECT_EQ(kind_of({soup.poses[0]}, [](auto&) {}), ErrorKind::usage);
}

}  // namespace
}  // namespace gnomon
