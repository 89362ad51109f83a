// SPDX-License-Identifier: Apache-2.0
// Shadows through every layout: against the brute-force oracle in double, and the same bits however the S-buffer is cut up.
#include <random>

#include "end_to_end/moving_triangles.hpp"
#include "lists.hpp"
#include "math/sample.h"
#include "oracle/brute_force.hpp"
#include "pipeline/light_records.hpp"
#include "pipeline/memory_plan.hpp"
#include "stage_test.hpp"
#include "support/tested_layouts.hpp"

namespace gnomon::test {
namespace {

struct ShadowSetup {
    std::string layout;
    uint32_t light_cells = 1;
    uint32_t band_share = 1;  ///< The S-buffer is cut into at least so many bands, if it can be.
    uint64_t most_slots = 1u << 20;
    uint32_t resolution = 64;
    bool counting = false;  ///< Of the ranges that are visited.
};

constexpr uint32_t kSpp = 4, kSeed = 3;

class ShadowTest : public StageTest {
protected:
    /// What was hit and lit, index (y * width + x) * kSpp + s; lit: bits of the lights, zero where nothing is hit.
    struct Answers {
        std::vector<uint32_t> triangle, lit;
        size_t bands = 0, faces = 0;
    };

    Answers run(const MovingTriangles& scene, glm::uvec2 size, const ShadowSetup& setup) {
        const auto segments = static_cast<uint32_t>(scene.poses.size()) - 1;
        const Bounds bounds = bounds_of(scene.scene, scene.poses);
        const Geometry geometry = pose_geometry(device(), programs(), scene.scene, scene.poses);
        const View view = camera_view(scene.scene.cameras[0], scene.poses, 0, size.x, size.y);
        const Bins bins = bin_prisms(device(), programs(), geometry, view, segments * kSpp);
        const auto light_count = static_cast<uint32_t>(scene.scene.lights.size());
        std::vector<LightSide> sides;
        for (uint32_t i = 0; i < light_count; ++i) {
            for (View& face : light_faces(scene.scene.lights[i], scene.poses, i, bounds, setup.resolution)) {
                LightSide& side = sides.emplace_back();
                side.light_ix = i;
                side.view = std::move(face);
            }
        }
        Answers answers;
        answers.faces = sides.size();
        for (LightSide& side : sides) {
            side.bins = bin_prisms(device(), programs(), geometry, side.view, setup.light_cells);
            const Layout layout = with_ranges(find_layout(setup.layout), false);
            add_layout_stages(device(), programs(), layout, {"raster/conservative", "sample/shadow"});
            auto s_buffer = std::make_unique<SBuffer>(
                device(), programs(),
                walk_bins(programs(), {geometry, side.bins}, layout.stage("raster/conservative"), side.view.orthographic),
                layout);
            side.bands = s_buffer->bands(setup.band_share == 1 ? 1ull << 40 : s_buffer->map_bytes() / setup.band_share + 16384);
            side.map = std::move(s_buffer);
            answers.bands = std::max(answers.bands, side.bands.size());
        }
        const gpu::Buffer lights = gpu::upload_new(device(), "lights", light_records(scene.scene, scene.poses));
        Sampler sampler(device(), programs(), geometry, view, bins, lights,
                        {.shadow_stage = "sample/shadow@" + setup.layout,
                         .spp = kSpp,
                         .seed = kSeed,
                         .light_count = light_count,
                         .most_slots = setup.most_slots,
                         .count_ranges = setup.counting});
        answers.triangle.assign(size_t(size.x) * size.y * kSpp, SampleRecord::kMiss);
        answers.lit.assign(answers.triangle.size(), 0);
        for (const Batch& batch : split_batches(bins.window, kSpp, setup.most_slots, kSpp)) {
            sampler.trace(batch);
            for (LightSide& side : sides) {
                for (const Band& band : side.bands) {
                    side.map->fill(band);
                    sampler.test_shadows(side, band, least_tolerance(bounds));
                }
            }
            const std::vector<uint32_t> hits = sampler.batch_hits(), lit = sampler.batch_lit(0);
            for (size_t slot = 0; slot < hits.size(); ++slot) {
                const auto [x, y, stratum] = slot_sample(batch, bins.grid, slot);
                if (x >= size.x || y >= size.y || hits[slot] == shared::kNone) continue;
                const size_t index = (size_t(y) * size.x + x) * kSpp + stratum;
                answers.triangle[index] = hits[slot] & ~shared::kReversed;
                answers.lit[index] = lit[slot] & ((1u << light_count) - 1u);
            }
        }
        return answers;
    }

    void expect_as_oracle(const MovingTriangles& scene, glm::uvec2 size, const Answers& answers) {
        const oracle::BruteForce brute_force(scene.scene, scene.poses, 0, size.x, size.y);
        uint64_t hits = 0, shadowed = 0, other_triangle = 0, other_light = 0;
        for (size_t i = 0; i < answers.triangle.size(); ++i) {
            const auto pixel = static_cast<uint32_t>(i / kSpp), x = pixel % size.x, y = pixel / size.x;
            const glm::vec3 p = shared::sample_point(shared::pixel_hash(x, y, kSeed), x, y, static_cast<uint32_t>(i % kSpp),
                                                     shared::stratum_length(kSpp));
            const SampleRecord expected = brute_force.sample(p.x, p.y, p.z);
            if (answers.triangle[i] != expected.triangle) {
                ++other_triangle;
            } else if (expected.triangle != SampleRecord::kMiss) {
                ++hits;
                shadowed += expected.lit == 0 ? 1 : 0;
                other_light += answers.lit[i] != expected.lit ? 1 : 0;
            }
        }
        EXPECT_GT(hits, answers.triangle.size() / 10);
        EXPECT_GT(shadowed, hits / 100);
        EXPECT_LE(other_triangle, answers.triangle.size() / 500);
        EXPECT_LE(other_light, hits / 300) << "of " << hits;
    }
};

glm::dquat turned(double degrees, const glm::dvec3& axis) {
    return glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
}

/// Triangles flying about in a cube of side 2, over a square that stands still; a camera from above.
MovingTriangles flying_unlit(uint32_t segments, uint32_t count, float size, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const auto vector = [&](float scale) {
        const float x = unit(random), y = unit(random);
        return scale * glm::vec3(x, y, unit(random));
    };
    MovingTriangles result(segments);
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 middle = vector(1.0f);
        const Corners corners = {middle + vector(size), middle + vector(size), middle + vector(size)};
        result.add(corners, vector(0.5f));
    }
    result.add({glm::vec3(-2, -1.5f, -2), glm::vec3(-2, -1.5f, 2), glm::vec3(2, -1.5f, 2)});
    result.add({glm::vec3(-2, -1.5f, -2), glm::vec3(2, -1.5f, 2), glm::vec3(2, -1.5f, -2)});
    result.add(Camera{}, {{glm::dvec3(0, 3, 5), turned(-32, {1, 0, 0})}});
    return result;
}

/// With a directional light and a spot from above.
MovingTriangles flying(uint32_t segments, uint32_t count, float size, uint32_t seed) {
    MovingTriangles result = flying_unlit(segments, count, size, seed);
    Light sun;
    result.add(sun, {{glm::dvec3(0), turned(-70, {1, 0.2, 0})}});
    Light spot;
    spot.kind = LightKind::spot;
    spot.outer_cone = 0.6f;
    result.add(spot, {{glm::dvec3(0.5, 4, 0.5), turned(-90, {1, 0, 0})}, {glm::dvec3(0.7, 4, 0.5), turned(-90, {1, 0, 0})}});
    return result;
}

// Ranges that only contain the true ones lead to more tests, and the same answers.
bool answers_exactly(const std::string& name) {
    const Layout layout = find_layout(name);
    return layout.lossless || layout.only_contains();
}

TEST_F(ShadowTest, AgreeWithTheOracleInEveryLayout) {
    for (uint32_t segments : {1u, 2u}) {
        const MovingTriangles scene = flying(segments, 60, 0.4f, segments);
        const glm::uvec2 size(50, 38);
        Answers first;
        for (const std::string& layout : tested_layouts()) {
            if (!answers_exactly(layout)) continue;
            SCOPED_TRACE(testing::Message() << layout << ", " << segments << " segments");
            const Answers answers = run(scene, size, {layout, segments, 1, 1u << 20, 64});
            if (first.lit.empty()) {
                first = answers;
                expect_as_oracle(scene, size, answers);
            }
            EXPECT_EQ(answers.triangle, first.triangle);
            EXPECT_EQ(answers.lit, first.lit);
        }
    }
}

// A point light among them that moves, so that they pass from one of its faces to another, and a spot that takes five faces.
TEST_F(ShadowTest, AgreeWithTheOracleInEveryFace) {
    for (uint32_t segments : {1u, 3u}) {
        MovingTriangles scene = flying_unlit(segments, 50, 0.4f, segments + 20);
        Light point;
        point.kind = LightKind::point;
        scene.add(point,
                  {{glm::dvec3(-0.3, 0.2, 0.1), turned(20, {1, 2, 3})}, {glm::dvec3(0.4, 0.1, 0.3), turned(80, {1, 0, 1})}});
        Light spot;
        spot.kind = LightKind::spot;
        spot.outer_cone = 1.57f;
        scene.add(spot, {{glm::dvec3(0.1, 0.7, 0.2), turned(-60, {1, 0.4, 0})}});
        const glm::uvec2 size(50, 38);
        const Answers answers = run(scene, size, {"array", segments, 1, 1u << 20, 64});
        EXPECT_EQ(answers.faces, 11u);
        expect_as_oracle(scene, size, answers);
        EXPECT_EQ(run(scene, size, {"linked", 4 * segments, 2, 1u << 20, 40}).lit, answers.lit);
    }
}

TEST_F(ShadowTest, CellsBandsAndBatchesDoNotMatter) {
    const MovingTriangles scene = flying(2, 80, 0.3f, 7);
    const glm::uvec2 size(40, 30);
    const Answers expected = run(scene, size, {"array", 2, 1, 1u << 20, 256});
    for (const std::string& layout : tested_layouts()) {
        if (!find_layout(layout).lossless) continue;
        for (const ShadowSetup& setup : {ShadowSetup{layout, 8, 1, 1u << 20, 256}, ShadowSetup{layout, 2, 3, 1u << 20, 256},
                                         ShadowSetup{layout, 4, 3, 256, 256, true}}) {
            const Answers answers = run(scene, size, setup);
            EXPECT_GE(answers.bands, std::min(2u, setup.band_share));
            EXPECT_EQ(answers.triangle, expected.triangle);
            EXPECT_EQ(answers.lit, expected.lit) << layout << ", " << setup.light_cells << " cells, " << answers.bands
                                                 << " bands, " << setup.most_slots << " slots";
        }
    }
}

// Lists of more ranges than one dispatch may walk.
TEST_F(ShadowTest, LongLists) {
    const MovingTriangles scene = flying(1, 30'000, 0.03f, 9);
    const glm::uvec2 size(12, 10);
    Answers first;
    for (const std::string& layout : tested_layouts()) {
        if (!answers_exactly(layout)) continue;
        SCOPED_TRACE(layout);
        const Answers answers = run(scene, size, {layout, 1, 1, 1u << 20, 1});
        if (first.lit.empty()) {
            first = answers;
            expect_as_oracle(scene, size, answers);
        }
        EXPECT_EQ(answers.lit, first.lit);
    }
}

}  // namespace
}  // namespace gnomon::test
