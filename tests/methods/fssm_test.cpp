// SPDX-License-Identifier: Apache-2.0
// Method fssm, all of it: the light of every camera sample against the oracle, whose samples of the light's view are found in
// closed form.
#include "methods/fssm.hpp"

#include <gmock/gmock.h>

#include <gnomon/error.hpp>
#include <memory>
#include <optional>

#include "math/sample.h"
#include "methods/level_scene.hpp"
#include "oracle/fssm.hpp"
#include "support/shared_devices.hpp"

namespace gnomon::test {
namespace {

constexpr uint32_t kSide = 40, kSpp = 2, kResolution = 60;
constexpr double kBias = 0.01;

/// The light's map, its samples and the tiles that were asked for.
class OracleMap {
public:
    OracleMap(const LevelScene& scene, const oracle::FssmSettings& settings, uint32_t spp, uint32_t seed)
        : scene_(scene),
          spp_(spp),
          settings_(settings),
          orthographic_(scene.scene.lights[0].kind == LightKind::directional),
          seed_(shared::hash_pcg(seed ^ shared::hash_pcg(1))),
          across_((static_cast<int>(kResolution) + settings.tile - 1) / settings.tile),
          tiles_(static_cast<size_t>(across_ * across_)) {
        view_ = light_faces(scene.scene.lights[0], scene.poses, 0, bounds_of(scene.scene, scene.poses), kResolution)[0];
    }

    /// Where the map shows a point at a time; texels from its corner.
    glm::dvec2 place(const glm::dvec3& p, double t) const {
        const double half = 0.5 * kResolution;
        const ViewKey& key = view_.keys[0];
        if (orthographic_) {
            const glm::dvec3 q = p - glm::dvec3(key.origin);
            return glm::dvec2(key.row_x.w, key.row_y.w) + half + glm::dvec2(view_.scale_x * q.x, view_.scale_y * q.z);
        }
        const glm::dvec3 q = p - scene_.at(scene_.light_keys, t);
        return half + glm::dvec2(view_.scale_x * q.x, view_.scale_y * q.z) / -q.y;
    }
    double depth(const glm::dvec3& p, double t) const {
        return (orthographic_ ? view_.keys[0].origin.y : scene_.at(scene_.light_keys, t).y) - p.y;
    }

    double visibility(const glm::ivec2& tile, oracle::FssmReceiver receiver) {
        std::optional<oracle::FssmTile>& kept = tiles_[static_cast<size_t>(tile.y * across_ + tile.x)];
        if (!kept) kept.emplace(window(tile), (glm::dvec2(tile) + 0.5) * double(settings_.tile), settings_);
        receiver.depth -= kBias;
        return kept->visibility(receiver);
    }

    int across() const { return across_; }

private:
    std::vector<oracle::MapSample> window(const glm::ivec2& tile) const {
        const int margin = (settings_.window - settings_.tile) / 2;
        const glm::ivec2 first = tile * settings_.tile - margin;
        std::vector<oracle::MapSample> samples;
        for (int y = first.y; y < first.y + settings_.window; ++y) {
            for (int x = first.x; x < first.x + settings_.window; ++x) {
                if (x < 0 || y < 0 || x >= int(kResolution) || y >= int(kResolution)) continue;
                const auto ux = static_cast<uint32_t>(x), uy = static_cast<uint32_t>(y);
                for (uint32_t s = 0; s < spp_; ++s)
                    samples.push_back(sample(
                        shared::sample_point(shared::pixel_hash(ux, uy, seed_), ux, uy, s, shared::stratum_length(spp_))));
            }
        }
        return samples;
    }

    oracle::MapSample sample(const glm::dvec3& point) const {
        const double t = point.z;
        const glm::dvec2 raster = glm::dvec2(point) - 0.5 * kResolution, scale(view_.scale_x, view_.scale_y);
        const glm::dvec3 light = scene_.at(scene_.light_keys, t);
        glm::dvec3 from = light;
        if (orthographic_) {
            const glm::dvec2 level = (raster - glm::dvec2(view_.keys[0].row_x.w, view_.keys[0].row_y.w)) / scale;
            from = glm::dvec3(view_.keys[0].origin) + glm::dvec3(level.x, 0.0, level.y);
            from.y = 1e3;
        }
        const LevelScene::Seen seen = scene_.look(from, orthographic_ ? glm::dvec2(0.0) : raster / scale, t);
        oracle::MapSample result{glm::dvec2(point), t};
        result.hit = seen.hit;
        if (!seen.hit) return result;
        result.depth = depth(seen.point, t);
        glm::dvec3 v = seen.velocity;
        if (orthographic_) {
            result.motion = glm::dvec3(scale.x * v.x, scale.y * v.z, -v.y);
        } else {
            // The quotient rule on scale * (p - light) / depth.
            v -= scene_.velocity(scene_.light_keys, t);
            const glm::dvec3 p = seen.point - light;
            const glm::dvec2 across = (glm::dvec2(v.x, v.z) * result.depth + glm::dvec2(p.x, p.z) * v.y);
            result.motion = glm::dvec3(scale * across / (result.depth * result.depth), -v.y);
        }
        return result;
    }

    const LevelScene& scene_;
    uint32_t spp_;
    oracle::FssmSettings settings_;
    bool orthographic_;
    uint32_t seed_;
    int across_;
    View view_;
    std::vector<std::optional<oracle::FssmTile>> tiles_;
};

struct Case {
    const char* name;
    LightKind kind;
    std::vector<glm::dvec3> light, camera;
    std::map<std::string, double> parameters;
    bool veiled = false;  ///< A wide square flies over all others.
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A floor, one that rests above it, two that cross above both and one that rises.
void add_rectangles(LevelScene& scene) {
    scene.add({6.0, 6.0}, {{0, 0, 0}});
    scene.add({0.9, 0.7}, {{0.3, 0.4, 0.2}});
    scene.add({1.0, 0.8}, {{-2.0, 1.3, 0.1}, {0.4, 1.3, 0.3}, {2.1, 1.3, 0.2}});
    scene.add({0.7, 1.1}, {{0.3, 2.6, 1.9}, {0.1, 2.6, 0.2}, {-0.4, 2.6, -2.0}});
    scene.add({0.8, 0.8}, {{2.0, 0.7, 2.0}, {2.0, 1.5, 2.0}, {2.1, 2.1, 2.0}});
}

class FssmOracleTest : public testing::TestWithParam<Case> {};

TEST_P(FssmOracleTest, EverySampleHasTheOraclesLight) {
    const Case& c = GetParam();
    LevelScene scene(c.light, c.camera, c.kind, 3.0);
    add_rectangles(scene);
    if (c.veiled) scene.add({2.0, 2.0}, {{-3.5, 3.4, 0.3}, {3.5, 3.4, 0.3}});
    RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.spp = kSpp;
    settings.seed = 3;
    settings.shadow_res = kResolution;
    settings.method = "fssm";
    settings.keep_samples = true;
    settings.parameters = c.parameters;
    settings.parameters.insert({"map-spp", 4});
    settings.parameters["bias"] = kBias;
    const Frame frame = validated_renderer().render(scene.scene, scene.poses, settings);

    const auto set = [&](const char* name) { return !c.parameters.contains(name) || c.parameters.at(name) != 0.0; };
    oracle::FssmSettings tiles;
    if (c.parameters.contains("tile")) tiles = {4, 12, 8};
    if (c.parameters.contains("layers")) tiles.layers = static_cast<int>(c.parameters.at("layers"));
    tiles.widen = set("widen");
    tiles.tent = set("tent");
    OracleMap map(scene, tiles, static_cast<uint32_t>(settings.parameters.at("map-spp")), settings.seed);
    uint64_t checked = 0, wrong = 0, between = 0;
    for (uint32_t i = 0; i < kSide * kSide * kSpp; ++i) {
        const uint32_t x = i / kSpp % kSide, y = i / kSpp / kSide, s = i % kSpp;
        const uint32_t hash = shared::pixel_hash(x, y, settings.seed);
        const glm::dvec3 point(shared::sample_point(hash, x, y, s, shared::stratum_length(kSpp)));
        const double t = point.z, metres = 2.0 * scene.half_height / kSide;
        const glm::dvec3 eye = scene.at(scene.camera_keys, t);
        const LevelScene::Seen seen =
            scene.look(eye + glm::dvec3(metres * (point.x - 0.5 * kSide), 0.0, metres * (point.y - 0.5 * kSide)), {0, 0}, t);
        ASSERT_TRUE(seen.hit);
        // Two triangles a rectangle; at its edges rounding decides.
        const glm::dvec2 at = map.place(seen.point, t);
        if (std::abs(double(frame.samples[i].depth) - (eye.y - seen.point.y)) > 1e-3) continue;
        ++checked;
        glm::ivec2 tile(glm::floor(at / double(tiles.tile)));
        if (set("neighbours")) {
            const uint32_t first = shared::hash_pcg(hash ^ shared::hash_pcg(0x85ebca6bu * s)), second = shared::hash_pcg(first);
            for (const int axis : {0, 1}) {
                const double within = at[axis] / tiles.tile - tile[axis] - 0.5;
                const double chance = std::max(0.0, (std::abs(within) - 1.0 / 3.0) / (0.5 - 1.0 / 3.0) * 0.5);
                if (shared::unit_float(axis == 0 ? first : second) < chance) tile[axis] += within < 0.0 ? -1 : 1;
            }
            tile = glm::clamp(tile, 0, map.across() - 1);
        }
        oracle::FssmReceiver receiver{at, at, t, t, map.depth(seen.point, t), t};
        if (set("footprint")) {
            receiver.t_begin = std::max(0.0, t - 0.5 / kSpp);
            receiver.t_end = std::min(1.0, t + 0.5 / kSpp);
            // At rest before the camera.
            const auto moved = [&](double when) { return seen.point + scene.at(scene.camera_keys, when) - eye; };
            receiver.begin = map.place(moved(receiver.t_begin), receiver.t_begin);
            receiver.end = map.place(moved(receiver.t_end), receiver.t_end);
        }
        const double expected = map.visibility(tile, receiver), found = frame.sample_visibility[i];
        wrong += std::abs(found - expected) > 2e-3 ? 1 : 0;
        between += expected > 0.02 && expected < 0.98 ? 1 : 0;
    }
    EXPECT_GT(checked, kSide * kSide * kSpp - 20u);
    EXPECT_LE(wrong, checked / 500);
    EXPECT_GT(between, checked / 20);
    RecordProperty("wrong", std::to_string(wrong));
}

const std::vector<glm::dvec3> kStill = {{0.1, 8, 0.2}, {0.1, 8, 0.2}}, kMoving = {{-0.4, 8, 0.2}, {0.5, 8.4, -0.1}},
                              kTurning = {{-0.4, 8, 0.2}, {0.1, 8.2, 0.3}, {0.5, 8.4, -0.1}}, kAbove = {{0, 9, 0}, {0, 9, 0}},
                              kPanning = {{-0.3, 9, 0.1}, {0.4, 9, 0.0}},
                              kTwice = {{-0.3, 9, 0.1}, {0.0, 9, 0.1}, {0.4, 9, 0.0}};

INSTANTIATE_TEST_SUITE_P(
    Cases, FssmOracleTest,
    testing::Values(
        Case{"directional", LightKind::directional, kStill, kAbove, {}},
        Case{"directional_two_segments", LightKind::directional, kTurning, kTwice, {}},
        Case{"spot", LightKind::spot, kStill, kAbove, {}}, Case{"camera_moves", LightKind::directional, kStill, kPanning, {}},
        Case{"light_moves", LightKind::spot, kMoving, kAbove, {}}, Case{"both_move", LightKind::spot, kMoving, kPanning, {}},
        Case{"both_move_two_segments", LightKind::spot, kTurning, kTwice, {}},
        Case{"small_tiles", LightKind::spot, kMoving, kPanning, {{"tile", 4}}},
        Case{"two_layers", LightKind::spot, kMoving, kPanning, {{"layers", 2}}},
        Case{"one_layer", LightKind::directional, kStill, kAbove, {{"layers", 1}}},
        Case{"no_footprint", LightKind::spot, kMoving, kPanning, {{"footprint", 0}}},
        Case{"sparse", LightKind::directional, kStill, kAbove, {{"map-spp", 1}, {"footprint", 0}}, true},
        Case{"no_widening", LightKind::directional, kStill, kAbove, {{"map-spp", 1}, {"footprint", 0}, {"widen", 0}}, true},
        Case{"no_tent", LightKind::directional, kStill, kAbove, {{"tent", 0}}},
        Case{"no_neighbours", LightKind::directional, kStill, kAbove, {{"neighbours", 0}}}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(FssmTest, TilesAreFourOrEightTexels) {
    LevelScene scene(kStill, kAbove, LightKind::directional, 3.0);
    add_rectangles(scene);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.method = "fssm";
    settings.parameters["tile"] = 5;
    Renderer renderer("", true);
    try {
        renderer.render(scene.scene, scene.poses, settings);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_THAT(error.what(), testing::HasSubstr("--tile"));
    }
}

}  // namespace
}  // namespace gnomon::test
