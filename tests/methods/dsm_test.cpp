// SPDX-License-Identifier: Apache-2.0
// Method dsm: clusters by hand and against plain loops, and frames that it must get right and wrong.
#include "methods/dsm.hpp"

#include <algorithm>
#include <bit>
#include <gnomon/error.hpp>
#include <random>

#include "shared/params.h"
#include "stage_test.hpp"
#include "stages/grid.hpp"
#include "support/two_cubes.hpp"

namespace gnomon::test {
namespace {

using Function = std::vector<glm::vec2>;  // Depths, and the visibility behind them.

class DsmTest : public StageTest {
protected:
    /// The functions of 64 texels; samples: [sample][texel].
    std::vector<Function> cluster(const std::vector<std::vector<float>>& samples, float extent, float extent_per_metre = 0.0f) {
        std::vector<float> flat;
        for (const auto& s : samples) flat.insert(flat.end(), s.begin(), s.end());
        const gpu::Buffer in = gpu::upload_new(device(), "samples", flat);
        const gpu::Buffer counts = device().allocate("counts", 64 * 4);
        const Unbound unbound(device(), 3);
        const gpu::Buffer offsets = gpu::upload_new(device(), "offsets", std::vector<uint32_t>(164, 7u));
        const auto run = [&](bool fill, const gpu::Binding& scanned, const gpu::Binding& clusters) {
            const std::vector<gpu::Binding> all = {{"map_samples", &in, gpu::Texel::r32_float},
                                                   scanned,
                                                   fill ? unbound.at(2, "Counts") : gpu::Binding{"Counts", &counts},
                                                   clusters,
                                                   {"Offsets", &offsets}};
            gpu::Recorder recorder(device());
            recorder.dispatch(
                "cluster", programs().get("methods/dsm/cluster", {fill}), all,
                shared::ClusterParams{1, static_cast<uint32_t>(samples.size()), 100, 1000, extent, extent_per_metre}, 1);
            recorder.submit();
        };
        run(false, unbound.at(0, "scanned", gpu::Texel::r32_uint), unbound.at(1, "Clusters"));
        const auto found = gpu::download_vector<uint32_t>(device(), counts, 64);
        std::vector<uint32_t> begin(1, 0u);
        for (const uint32_t c : found) begin.push_back(begin.back() + c);
        const gpu::Buffer clusters = device().allocate("clusters", begin.back() * sizeof(glm::vec2));
        const gpu::Buffer scanned = gpu::upload_new(device(), "scanned", begin);
        run(true, {"scanned", &scanned, gpu::Texel::r32_uint}, {"Clusters", &clusters});
        const auto all = gpu::download_vector<glm::vec2>(device(), clusters, begin.back());
        const auto places = gpu::download_vector<uint32_t>(device(), offsets, 164);
        std::vector<Function> result;
        for (size_t i = 0; i < 64; ++i) {
            EXPECT_EQ(places[100 + i], 1000 + begin[i]);
            result.emplace_back(all.begin() + begin[i], all.begin() + begin[i + 1]);
        }
        EXPECT_EQ(places[99], 7u) << "written outside of the batch";
        return result;
    }
};

// Two of four samples near 1, one at 3, one sees nothing: half the light goes on behind 1, a quarter behind 3.
TEST_F(DsmTest, OpacityIsTheShareOfSamplesThatGotThere) {
    const auto row = [](float depth) { return std::vector<float>(64, depth); };
    for (const Function& f : cluster({row(1.25f), row(3.0f), row(1.0f), row(shared::kFarthest)}, 0.25f)) {
        ASSERT_EQ(f.size(), 2u);
        EXPECT_EQ(f[0], glm::vec2(1.125f, 0.5f));
        EXPECT_EQ(f[1], glm::vec2(3.0f, 0.25f));
    }
    for (const Function& f : cluster({row(1.25f), row(1.0f)}, 0.125f)) EXPECT_EQ(f.size(), 2u);
    for (const Function& f : cluster({row(shared::kFarthest)}, 1.0f)) EXPECT_TRUE(f.empty());
    // An eighth of the depth: 0.125 at 1, 0.5 at 4.
    for (const Function& f : cluster({row(1.25f), row(4.25f), row(1.0f), row(4.0f)}, 0.0f, 0.125f)) {
        ASSERT_EQ(f.size(), 3u);
        EXPECT_EQ(f[2], glm::vec2(4.125f, 0.0f));
    }
}

TEST_F(DsmTest, ClustersAreThoseOfSortedSamples) {
    std::mt19937 random(3);
    std::normal_distribution<float> spread(0.0f, 0.3f);
    std::vector<std::vector<float>> samples(128, std::vector<float>(64));
    for (size_t s = 0; s < samples.size(); ++s) {
        for (size_t t = 0; t < 64; ++t)
            samples[s][t] =
                random() % 4 == 0 ? shared::kFarthest : static_cast<float>(2 + random() % (1 + t / 8)) + spread(random);
    }
    const std::vector<Function> found = cluster(samples, 0.4f);
    size_t most = 0;
    for (size_t t = 0; t < 64; ++t) {
        std::vector<double> depths;
        for (const auto& s : samples) {
            if (s[t] != shared::kFarthest) depths.push_back(double(s[t]));
        }
        std::sort(depths.begin(), depths.end());
        std::vector<glm::dvec2> expected;
        double left = 1.0;
        for (size_t i = 0; i < depths.size();) {
            double sum = 0.0, held = 0.0;
            const double first = depths[i];
            for (; i < depths.size() && static_cast<float>(depths[i]) <= static_cast<float>(first) + 0.4f; ++i) {
                sum += depths[i];
                held += 1.0;
            }
            left -= held / 128.0;
            expected.emplace_back(sum / held, left);
        }
        most = std::max(most, expected.size());
        ASSERT_EQ(found[t].size(), expected.size()) << t;
        for (size_t i = 0; i < expected.size(); ++i) {
            EXPECT_NEAR(double(found[t][i].x), expected[i].x, 1e-5);
            EXPECT_NEAR(double(found[t][i].y), expected[i].y, 1e-6);
        }
    }
    EXPECT_GT(most, 5u);
}

class DsmFramesTest : public TwoCubes<> {
protected:
    DsmFramesTest() : TwoCubes(96, 64, 8) {
        settings.keep_samples = true;
        settings.shadow_res = 512;
    }

    struct Error {
        double samples = 0.0, bias = 0.0;
    };

    /// Mean of the visibility less the exact method's, of samples on moving or still triangles.
    Error error(const Frame& frame, const Frame& exact, bool moving) {
        const std::vector<glm::vec3> first = posed_positions(scene, poses.front()), last = posed_positions(scene, poses.back());
        Error e;
        for (size_t i = 0; i < exact.samples.size(); ++i) {
            if (exact.samples[i].triangle == SampleRecord::kMiss) continue;
            const uint32_t vertex = scene.triangles[exact.samples[i].triangle].vertex[0];
            if ((first[vertex] != last[vertex]) != moving) continue;
            const double difference = double(frame.sample_visibility.at(i)) - (exact.samples[i].lit & 1u);
            e.samples += 1.0;
            e.bias += difference;
        }
        e.bias /= e.samples;
        return e;
    }
};

// On the ground, which is still, the mean is right but for texels and bias; on the cubes, which shadow themselves, it is not.
TEST_F(DsmFramesTest, IsRightOnStillReceiversAndWrongOnMovingOnes) {
    const Frame exact = render("exact"), dsm = render("dsm");
    const Error still = error(dsm, exact, false), moving = error(dsm, exact, true);
    RecordProperty("still", std::to_string(still.bias));
    RecordProperty("moving", std::to_string(moving.bias));
    EXPECT_GT(still.samples, 1000.0);
    EXPECT_GT(moving.samples, 1000.0);
    EXPECT_LT(std::fabs(still.bias), 0.01);
    EXPECT_LT(moving.bias, -0.1);
}

TEST_F(DsmFramesTest, MeansAndErrorsAreThoseOfTheSamples) {
    const Frame frame = render("dsm");
    const auto find = [&](const std::string& name) {
        return std::find_if(frame.channels.begin(), frame.channels.end(), [&](const Channel& c) { return c.name == name; })
            ->values;
    };
    const std::vector<float> mean = find("visibility.0"), spread = find("visibility_var.0");
    uint64_t graded = 0;
    for (size_t pixel = 0; pixel < mean.size(); ++pixel) {
        double n = 0.0, sum = 0.0, squares = 0.0;
        for (size_t s = 0; s < settings.spp; ++s) {
            const size_t i = pixel * settings.spp + s;
            if (frame.samples[i].triangle == SampleRecord::kMiss) continue;
            const double v = double(frame.sample_visibility[i]);
            n += 1.0;
            sum += v;
            squares += v * v;
            graded += v > 0.0 && v < 1.0 ? 1 : 0;
            EXPECT_EQ((frame.samples[i].lit & 1u) != 0, v >= 0.5);
        }
        const double m = n > 0.0 ? sum / n : 0.0, variance = n > 0.0 ? std::max(0.0, squares / n - m * m) : 0.0;
        EXPECT_NEAR(double(mean[pixel]), m, 1e-6);
        EXPECT_NEAR(double(spread[pixel]), std::sqrt(variance / std::max(1.0, n - 1.0)), 1e-3);
    }
    EXPECT_GT(graded, 100u);
}

// Parts of a wide spot's map that see nothing have no clusters.
TEST_F(DsmFramesTest, EmptyPartsOfTheMapLeaveTheOthersAsTheyAre) {
    Light& light = scene.lights.at(0);
    light.kind = LightKind::spot;
    light.outer_cone = 1.4f;
    light.inner_cone = 0.0f;
    settings.shadow_res = 1024;
    settings.parameters["map-spp"] = 64;
    const Frame frame = render("dsm");
    EXPECT_GT(frame.stats.counts.at("clusters.0"), 1000u);
    settings.parameters.clear();
    EXPECT_LT(std::fabs(error(frame, render("exact"), false).bias), 0.03);
}

TEST_F(DsmFramesTest, BatchesAndWindowsDoNotMatterAndTooLittleMemoryIsSaid) {
    const Frame expected = render("dsm");
    settings.memory_budget = expected.stats.peak_bytes + (1u << 20);
    expect_same_bits(render("dsm"), expected);
    settings.memory_budget = 16u << 20;
    expect_same_bits(render("dsm"), expected);
    settings.memory_budget = 1u << 20;
    EXPECT_THROW(render("dsm"), gnomon::Error);
}

}  // namespace
}  // namespace gnomon::test
