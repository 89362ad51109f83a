// SPDX-License-Identifier: Apache-2.0
// Methods tsm, tsm-dynamic-bias and accumulate: every sample of a map against the oracle, and shadow tests whose answers are
// known in closed form.
#include "methods/depth_map.hpp"

#include <algorithm>
#include <map>

#include "end_to_end/moving_triangles.hpp"
#include "math/sample.h"
#include "soup.hpp"
#include "stage_test.hpp"
#include "support/shared_devices.hpp"
#include "support/two_cubes.hpp"

namespace gnomon::test {
namespace {

class DepthMapTest : public StageTest {};

struct MapSample {
    float depth = 0.0f;
    float motion = 0.0f;
};

/// Of a map, index stratum * texels + texel, in the order in which the shadow test reads them; in bands of at most `bytes`.
std::vector<MapSample> map_samples(gpu::Device& device, DepthMap& map, bool motion, uint64_t bytes) {
    std::vector<MapSample> result;
    for (const Band& band : map.bands(bytes)) {
        map.fill(band);
        EXPECT_EQ(map.range_base(), result.size());
        const std::vector<gpu::Binding> bound = map.read_bindings();
        const auto floats = gpu::download_vector<float>(device, *bound.at(0).buffer, band.range_count * (motion ? 2 : 1));
        for (size_t i = 0; i < band.range_count; ++i) {
            result.push_back(motion ? MapSample{floats[2 * i], floats[2 * i + 1]} : MapSample{floats[i], 0.0f});
        }
    }
    return result;
}

struct Checked {
    uint64_t seen = 0, unseen = 0;
    uint64_t other = 0;  ///< Samples in which something else is seen, or nothing.
    double depth_error = 0.0, motion_error = 0.0;
};

/// x and y of a texel from its place in a tile-major map.
glm::uvec2 texel_of(const shared::ViewGrid& grid, uint32_t i) {
    const uint32_t tile = i / shared::kTileTexels, place = i % shared::kTileTexels;
    return {tile % grid.tiles_x * shared::kTileSize + place % shared::kTileSize,
            tile / grid.tiles_x * shared::kTileSize + place / shared::kTileSize};
}

Checked check_map(const Soup& soup, const shared::ViewGrid& grid, const std::vector<MapSample>& samples,
                  const Sampling& sampling, bool motion) {
    std::vector<std::vector<oracle::MovingTriangle>> triangles;
    for (uint32_t k = 0; k < soup.segments(); ++k) triangles.push_back(soup.all_triangles(k));
    const View view = soup.view();
    const uint32_t texels = grid.tiles_x * ((grid.height + 7) / 8) * shared::kTileTexels;
    Checked checked;
    for (uint32_t i = 0; i < samples.size(); ++i) {
        const glm::uvec2 texel = texel_of(grid, i % texels);
        if (texel.x >= soup.width || texel.y >= soup.height) continue;
        const uint32_t stratum = i / texels, hash = shared::pixel_hash(texel.x, texel.y, sampling.seed);
        const glm::dvec3 p =
            sampling.sliced
                ? glm::dvec3(texel.x + 0.5, texel.y + 0.5, (stratum + 0.5) / sampling.spp)
                : glm::dvec3(shared::sample_point(hash, texel.x, texel.y, stratum, shared::stratum_length(sampling.spp)));
        const auto segment = std::min(static_cast<uint32_t>(p.z * soup.segments()), soup.segments() - 1);
        const double s = p.z * soup.segments() - segment;
        const std::vector<oracle::Seen> seen =
            seen_at(triangles[segment], p.x - 0.5 * soup.width, p.y - 0.5 * soup.height, s, view.depth_near, view.depth_far);
        if (seen.empty()) {
            ++checked.unseen;
            checked.other += samples[i].depth != shared::kFarthest || samples[i].motion != 0.0f ? 1 : 0;
            continue;
        }
        ++checked.seen;
        const oracle::MovingTriangle& t = triangles[segment][seen[0].triangle];
        double start = 0.0, end = 0.0;
        for (glm::length_t v = 0; v < 3; ++v) {
            const auto metres = [&](const glm::dvec4& q) { return soup.orthographic ? q.z : q.w; };
            start += seen[0].surface.barycentrics[v] * metres(t.start[static_cast<size_t>(v)]);
            end += seen[0].surface.barycentrics[v] * metres(t.end[static_cast<size_t>(v)]);
        }
        const double depth = start + s * (end - start), moved = motion ? (end - start) * soup.segments() : 0.0;
        const double depth_error = std::abs(samples[i].depth - depth) / (1.0 + std::abs(depth));
        if (depth_error > 1e-2) {
            ++checked.other;
            continue;
        }
        checked.depth_error = std::max(checked.depth_error, depth_error);
        checked.motion_error = std::max(checked.motion_error, std::abs(samples[i].motion - moved) / (1.0 + std::abs(moved)));
    }
    return checked;
}

// Big triangles in front of each other, so that what is seen and how it moves is well conditioned everywhere.
Soup overlapping(uint32_t segments, bool orthographic, std::mt19937& random) {
    Soup soup(segments, 45, 27, orthographic);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (uint32_t i = 0; i < 12; ++i) {
        glm::uvec3 triangle;
        for (glm::length_t v = 0; v < 3; ++v) {
            std::vector<glm::vec4> places;
            glm::vec3 at(30.0f * unit(random), 20.0f * unit(random), 6.0f + unit(random));
            for (uint32_t k = 0; k <= segments; ++k) {
                places.push_back(orthographic ? glm::vec4(at, 1.0f) : glm::vec4(at.x * at.z, at.y * at.z, -1.0f, at.z));
                at += glm::vec3(8.0f * unit(random), 8.0f * unit(random), 1.5f * unit(random));
            }
            triangle[v] = soup.add_vertex(places);
        }
        soup.triangles.push_back(triangle);
    }
    return soup;
}

TEST_F(DepthMapTest, SamplesAreWhatTheOracleSees) {
    std::mt19937 random(5);
    for (const bool orthographic : {false, true}) {
        for (const uint32_t segments : {1u, 3u}) {
            for (const DepthMapKind kind : {DepthMapKind::stochastic, DepthMapKind::dynamic_bias, DepthMapKind::slices}) {
                const bool motion = kind == DepthMapKind::dynamic_bias, sliced = kind == DepthMapKind::slices;
                SCOPED_TRACE(testing::Message() << (orthographic ? "orthographic, " : "perspective, ") << segments
                                                << " segments, motion " << motion << ", sliced " << sliced);
                const Soup soup = overlapping(segments, orthographic, random);
                const Scene scene = soup.scene();
                const std::vector<Pose> poses = soup.poses();
                const View view = soup.view();
                const Geometry geometry = pose_geometry(device(), programs(), scene, poses);
                RenderSettings settings;
                settings.parameters[sliced ? "slices" : "map-spp"] = 7;
                const Method& method = find_method(motion ? "tsm-dynamic-bias" : sliced ? "accumulate" : "tsm");
                const LightContext light{device(), programs(), geometry, settings, method, view, 0, false, 1ull << 30, {}, ""};
                const Bins bins = bin_prisms(device(), programs(), geometry, view, method.light_cells(light));
                DepthMap map(light, bins, kind);
                const std::vector<MapSample> samples = map_samples(device(), map, motion, 1ull << 40);
                ASSERT_EQ(samples.size(), map.counts().at("map_samples"));
                const Checked checked = check_map(soup, bins.grid, samples, map_sampling(light, kind), motion);
                EXPECT_GT(checked.seen, 2000u);
                EXPECT_GT(checked.unseen, 100u);
                EXPECT_LE(checked.other, checked.seen / 1000);  // At silhouettes, by rounding.
                EXPECT_LT(checked.depth_error, 2e-5);
                EXPECT_LT(checked.motion_error, 2e-4);

                // A band a stratum: the same samples.
                const uint64_t stratum = uint64_t(bins.window.tile_count) * shared::kTileTexels * (motion ? 8 : 4);
                EXPECT_EQ(map.bands(stratum).size(), 7u);
                const std::vector<MapSample> cut = map_samples(device(), map, motion, stratum);
                ASSERT_EQ(cut.size(), samples.size());
                EXPECT_TRUE(std::equal(cut.begin(), cut.end(), samples.begin(), [](const MapSample& a, const MapSample& b) {
                    return a.depth == b.depth && a.motion == b.motion;
                }));
            }
        }
    }
}

// A level square that rises by `rise` metres during the shutter toward a light straight above it, which nothing shadows. A hit
// at time t meets the sample that its texel has in the same stratum, at time s: false shadow, where the square is higher then
// by more than the bias: rise (s - t) > bias.
class RisingSquareTest : public StageTest, public testing::WithParamInterface<LightKind> {
protected:
    static constexpr uint32_t kSpp = 4, kSide = 32;
    static constexpr double kRise = 2.0;

    RisingSquareTest() : scene(1) {
        const glm::vec3 up(0.0f, static_cast<float>(kRise), 0.0f);
        const glm::vec3 a(-4, 0, -4), b(-4, 0, 4), c(4, 0, 4), d(4, 0, -4);
        scene.add({a, b, c}, up);
        scene.add({a, c, d}, up);
        const glm::dquat down = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
        Camera camera;
        camera.kind = CameraKind::orthographic;
        camera.xmag = camera.ymag = 3.0;
        scene.add(camera, {{glm::dvec3(0, 10, 0), down}});
        Light light;
        light.kind = GetParam();
        light.outer_cone = 0.9f;
        scene.add(light, {{glm::dvec3(0, 12, 0), down}});
        settings.width = settings.height = kSide;
        settings.spp = kSpp;
        settings.seed = 11;
        settings.shadow_res = 64;
        settings.keep_samples = true;
    }

    Frame render(const std::string& method, double bias) {
        settings.method = method;
        if (method != "exact") settings.parameters["bias"] = bias;
        return render_as_set();
    }

    Frame render_as_set() { return validated_renderer().render(scene.scene, scene.poses, settings); }

    static uint64_t shadowed(const Frame& frame) {
        return static_cast<uint64_t>(
            std::count_if(frame.samples.begin(), frame.samples.end(), [](const SampleRecord& s) { return (s.lit & 1u) == 0; }));
    }

    MovingTriangles scene;
    RenderSettings settings;
};

TEST_P(RisingSquareTest, ShadowsItselfAsOftenAsTheTimesAreMismatched) {
    constexpr double kSamples = double(kSide) * kSide * kSpp;
    for (const double bias : {0.0, 0.1, 0.3, 0.6}) {
        const Frame frame = render("tsm", bias);
        ASSERT_EQ(frame.samples.size(), static_cast<size_t>(kSamples));
        EXPECT_TRUE(std::all_of(frame.samples.begin(), frame.samples.end(),
                                [](const SampleRecord& s) { return s.triangle != SampleRecord::kMiss; }));
        // s - t of two times that are uniform in a stratum of 1 / N is more than bias / rise with probability (1 - d)^2 / 2.
        const double d = std::min(1.0, bias / kRise * kSpp), p = 0.5 * (1.0 - d) * (1.0 - d);
        const double error = std::sqrt(p * (1.0 - p) / kSamples);
        EXPECT_NEAR(static_cast<double>(shadowed(frame)) / kSamples, p, 5.0 * error + 1e-3) << "bias " << bias;
        EXPECT_EQ(frame.effective.at("map_spp"), "4");
    }
}

// A spot's texels are wider the farther they are, and so is the bias; the light is 12 metres above the square at first.
TEST_P(RisingSquareTest, WithoutABiasTakesTwoTexelsWidth) {
    settings.parameters.clear();
    settings.method = "tsm";
    settings.shadow_res = 256;
    const Frame frame = render_as_set();
    const bool spot = GetParam() == LightKind::spot;
    const double width = spot ? 2.0 * std::tan(0.9) / 256.0 : std::stod(frame.effective.at("bias")) / 2.0;
    if (spot) {
        EXPECT_NEAR(std::stod(frame.effective.at("bias_per_metre")), 2.0 * width, 0.02 * width);
    }
    double p = 0.0;
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps, end = (std::floor(t * kSpp) + 1.0) / kSpp;
        const double bias = 2.0 * width * (spot ? 12.0 - kRise * t : 1.0);
        p += std::max(0.0, end - t - bias / kRise) * kSpp / kSteps;
    }
    constexpr double kSamples = double(kSide) * kSide * kSpp;
    EXPECT_GT(p, 0.02);
    EXPECT_LT(p, 0.45);
    EXPECT_NEAR(static_cast<double>(shadowed(frame)) / kSamples, p, 5.0 * std::sqrt(p * (1.0 - p) / kSamples) + 1e-3);
}

TEST_P(RisingSquareTest, DoesNotShadowItselfWhenDepthsAreMovedToItsTime) {
    EXPECT_EQ(shadowed(render("exact", 0.0)), 0u);
    EXPECT_EQ(shadowed(render("tsm-dynamic-bias", 1e-4)), 0u);
}

INSTANTIATE_TEST_SUITE_P(Lights, RisingSquareTest, testing::Values(LightKind::directional, LightKind::spot),
                         [](const auto& tested) { return tested.param == LightKind::spot ? "spot" : "directional"; });

/// Samples of the shipped scene whose light differs from that of the exact method.
class DepthMapCubesTest : public TwoCubes<> {
protected:
    DepthMapCubesTest() : TwoCubes(96, 64, 8) { settings.keep_samples = true; }

    double wrong_share(const std::string& method) {
        settings.parameters.clear();
        const Frame exact = render("exact");
        if (method != "exact") settings.parameters = parameters;
        return differing(render(method), exact);
    }

    std::map<std::string, double> parameters;
};

// With a bias that surfaces at rest need.
TEST_F(DepthMapCubesTest, MovingTowardTheLightIsWrongUntilDepthsMove) {
    settings.shadow_res = 2048;
    parameters["bias"] = 0.1;
    const double tsm = wrong_share("tsm"), moved = wrong_share("tsm-dynamic-bias");
    RecordProperty("tsm", std::to_string(tsm));
    RecordProperty("tsm_dynamic_bias", std::to_string(moved));
    EXPECT_GT(tsm, 0.01);
    EXPECT_LT(moved, tsm / 3.0);
}

TEST_F(DepthMapCubesTest, StillScenesAreRightButForTexelsAndBias) {
    poses.assign(poses.size(), poses.front());
    double before = 1.0;
    for (const uint32_t resolution : {128u, 512u, 2048u}) {
        settings.shadow_res = resolution;
        const double share = wrong_share("tsm");
        RecordProperty("share_" + std::to_string(resolution), std::to_string(share));
        EXPECT_LT(share, before);
        before = share;
    }
    EXPECT_LT(before, 0.02);
}

// Slices mix times less the more there are, and texels places; what then remains is the bias.
TEST_F(DepthMapCubesTest, SlicesNearTheExactMethod) {
    settings.shadow_res = 1024;
    parameters["bias"] = 0.1;
    double before = 1.0;
    for (const double slices : {2.0, 8.0, 32.0}) {
        parameters["slices"] = slices;
        const double share = wrong_share("accumulate");
        RecordProperty("share_" + std::to_string(static_cast<int>(slices)), std::to_string(share));
        EXPECT_LT(share, 0.75 * before) << slices;
        before = share;
    }
    EXPECT_LT(before, 0.008);
}

TEST_F(DepthMapCubesTest, MemoryAndBatchesDoNotMatter) {
    for (const char* method : {"tsm", "tsm-dynamic-bias"}) {
        settings.memory_budget = 0;
        parameters["map-spp"] = settings.parameters["map-spp"] = 12;
        const Frame expected = render(method);
        settings.memory_budget = 24u << 20;
        const Frame frame = render(method);
        EXPECT_LT(frame.stats.buffer_bytes.at("map_samples"), expected.stats.buffer_bytes.at("map_samples")) << "no bands";
        expect_same_bits(frame, expected);
    }
}

}  // namespace
}  // namespace gnomon::test
