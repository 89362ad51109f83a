// SPDX-License-Identifier: Apache-2.0
// The S-buffers that a frame gives: what the oracle sees from the light is in them, whatever the layout, the budget, the pages
// and the faces; and in a file they come back as they are.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "end_to_end/moving_triangles.hpp"
#include "io/sbuffer_check.hpp"
#include "layouts/layout.hpp"
#include "oracle/moving_triangle.hpp"
#include "oracle/posed.hpp"
#include "support/paths.hpp"
#include "support/shared_devices.hpp"
#include "unit/io/test_folder.hpp"
#include "views/view.hpp"

namespace gnomon::test {
namespace {

constexpr uint32_t kSide = 24;
constexpr uint32_t kSegments = 2;

/// Triangles that pass each other around the origin, one of them standing still, seen by a camera above.
MovingTriangles small_scene(LightKind kind) {
    MovingTriangles scene(kSegments);
    scene.add({glm::vec3(-2, -1, 2), glm::vec3(2, -1, 2), glm::vec3(0, -1, -2.5)});
    scene.add({glm::vec3(-1, 0.2, 0.3), glm::vec3(0, 0.4, 0.5), glm::vec3(-0.5, 0.1, -0.6)}, {1.4f, 0.3f, 0.1f});
    scene.add({glm::vec3(0.7, 0.5, 0.3), glm::vec3(0.2, 0.9, -0.4), glm::vec3(-0.1, 0.6, 0.8)}, {-0.6f, -0.4f, 0.5f});
    const Rigid above{{0.0, 3.0, 0.0}, glm::angleAxis(-1.5707963, glm::dvec3(1.0, 0.0, 0.0))};
    Camera camera;
    camera.yfov = 1.2f;
    scene.add(camera, {above});
    Light light;
    light.kind = kind;
    light.intensity = 5.0f;
    light.outer_cone = 0.9f;
    scene.add(light, {{{0.3, 2.0, 0.1}, above.rotation}});
    return scene;
}

Frame dumped(const PosedScene& posed, RenderSettings settings) {
    settings.width = settings.height = 16;
    settings.spp = 2;
    settings.shadow_res = kSide;
    settings.keep_ranges = settings.keep_texel_ranges = true;
    return validated_renderer().render(posed.scene, posed.poses, settings);
}

/// As the view sees it in a segment.
oracle::MovingTriangle seen(const PosedScene& posed, const View& view, uint32_t triangle, uint32_t segment) {
    oracle::MovingTriangle result;
    for (uint32_t end = 0; end < 2; ++end) {
        const ViewKey& key = view.keys.at(segment + end);
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec3 p =
                oracle::posed_position(posed.scene, posed.poses[segment + end], posed.scene.triangles[triangle].vertex[i]);
            const glm::dvec4 q(p - glm::dvec3(key.origin), 1.0);
            (end == 0 ? result.start : result.end)[i] = {glm::dot(glm::dvec4(key.row_x), q), glm::dot(glm::dvec4(key.row_y), q),
                                                         glm::dot(glm::dvec4(key.row_z), q),
                                                         glm::dot(glm::dvec4(key.row_w), q)};
        }
    }
    return result;
}

/// A triangle in a texel of a face, in a segment.
struct Stay {
    uint32_t texel, triangle, segment;
    oracle::MovingTriangle motion;
    glm::dvec2 centre;
};

/// Call for each stay that there could be.
template <class Call>
void for_each_texel(const PosedScene& posed, Call call) {
    const std::vector<View> views =
        light_faces(posed.scene.lights[0], posed.poses, 0, bounds_of(posed.scene, posed.poses), kSide);
    for (size_t face = 0; face < views.size(); ++face) {
        for (uint32_t segment = 0; segment < kSegments; ++segment) {
            for (uint32_t t = 0; t < posed.scene.triangles.size(); ++t) {
                const oracle::MovingTriangle motion = seen(posed, views[face], t, segment);
                for (uint32_t texel = 0; texel < kSide * kSide; ++texel) {
                    const glm::dvec2 centre = glm::dvec2(texel % kSide, texel / kSide) - 0.5 * kSide + 0.5;
                    call(views[face], Stay{static_cast<uint32_t>(face) * kSide * kSide + texel, t, segment, motion, centre});
                }
            }
        }
    }
}

double metres(const View& view, const oracle::Surface& surface) {
    return view.orthographic ? surface.depth : -1.0 / surface.depth;
}

/// Of the corners in the segment the nearest; 0 where one is behind the light.
double nearest_corner(const View& view, const oracle::MovingTriangle& triangle) {
    double nearest = std::numeric_limits<double>::max();
    for (const auto& corners : {triangle.start, triangle.end})
        for (const glm::dvec4& corner : corners)
            nearest = std::min(nearest, view.orthographic ? corner.z : std::max(0.0, corner.w));
    return nearest;
}

const TexelRange* range_at(const LightRanges& light, uint32_t texel, uint32_t triangle, double time) {
    const auto first = std::lower_bound(light.ranges.begin(), light.ranges.end(), texel,
                                        [](const TexelRange& r, uint32_t at) { return r.texel < at; });
    for (auto r = first; r != light.ranges.end() && r->texel == texel; ++r)
        if (r->triangle == triangle && r->enter <= time && time <= r->leave) return &*r;
    return nullptr;
}

constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

TEST(FrameRanges, HoldWhatTheOracleSeesInATexel) {
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(static_cast<int>(kind));
        const MovingTriangles scene = small_scene(kind);
        RenderSettings settings;
        settings.closed_meshes = false;
        const Frame frame = dumped(scene, settings);
        const LightRanges& light = frame.light_ranges.at(0);
        EXPECT_EQ(light.faces, kind == LightKind::point ? 6u : 1u);
        EXPECT_EQ(light.width, kSide);
        EXPECT_EQ(light.height, kSide * light.faces);
        uint64_t instants = 0, missed = 0, too_deep = 0, too_near = 0;
        for_each_texel(scene, [&](const View& view, const Stay& stay) {
            for (const double s : {0.0, 0.31, 0.77, 1.0}) {
                if (!oracle::orientation_in(stay.motion, {stay.centre - 0.5, stay.centre + 0.5}, s)) continue;
                ++instants;
                const TexelRange* range = range_at(light, stay.texel, stay.triangle, (stay.segment + s) / kSegments);
                missed += range == nullptr ? 1 : 0;
                // At its ends the range may be that of the segment beside it.
                const bool inside = range != nullptr && s > 0.0 && s < 1.0;
                too_near += inside && range->depth < nearest_corner(view, stay.motion) - 1e-5 ? 1 : 0;
                const auto surface = oracle::surface_at(stay.motion, stay.centre.x, stay.centre.y, s);
                too_deep += range != nullptr && surface && range->depth > metres(view, *surface) + 1e-6 ? 1 : 0;
            }
        });
        EXPECT_GT(instants, 500u);
        EXPECT_EQ(missed, 0u) << "of " << instants;
        EXPECT_EQ(too_deep, 0u) << "of " << instants;
        EXPECT_EQ(too_near, 0u) << "of " << instants;
        std::vector<uint32_t> counts(size_t(light.width) * light.height);
        for (const TexelRange& range : light.ranges) {
            ++counts.at(range.texel);
            EXPECT_EQ(range.exit_depth, range.depth);
        }
        EXPECT_EQ(frame.texel_ranges.at(0), counts);
    }
}

TEST(FrameRanges, OfCentresAreTheOraclesStays) {
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(static_cast<int>(kind));
        const MovingTriangles scene = small_scene(kind);
        RenderSettings settings;
        settings.method = "dtr-analytic";
        const LightRanges light = dumped(scene, settings).light_ranges.at(0);
        EXPECT_TRUE(light.exit_depths);
        constexpr double kNear = 2e-4;
        uint64_t stays = 0, lost = 0, elsewhere = 0;
        for_each_texel(scene, [&](const View& view, const Stay& stay) {
            for (const oracle::Stay& s : oracle::stays_at(stay.motion, stay.centre.x, stay.centre.y)) {
                if (s.leave - s.enter < 0.01) continue;
                ++stays;
                const TexelRange* range =
                    range_at(light, stay.texel, stay.triangle, (stay.segment + 0.5 * (s.enter + s.leave)) / kSegments);
                if (range == nullptr) {
                    ++lost;
                    continue;
                }
                // Just inside: at its ends the oracle may see it by rounding or not.
                const double inside = 1e-9;
                const auto enter = oracle::surface_at(stay.motion, stay.centre.x, stay.centre.y, s.enter + inside);
                const auto leave = oracle::surface_at(stay.motion, stay.centre.x, stay.centre.y, s.leave - inside);
                const bool same = std::abs(range->enter - (stay.segment + s.enter) / kSegments) < kNear &&
                                  std::abs(range->leave - (stay.segment + s.leave) / kSegments) < kNear && enter && leave &&
                                  std::abs(range->depth - metres(view, *enter)) < kNear &&
                                  std::abs(range->exit_depth - metres(view, *leave)) < kNear;
                elsewhere += same ? 0 : 1;
            }
        });
        EXPECT_GT(stays, 100u);
        EXPECT_EQ(lost, 0u) << "of " << stays;
        EXPECT_EQ(elsewhere, 0u) << "of " << stays;
        EXPECT_NEAR(static_cast<double>(light.ranges.size()), static_cast<double>(stays), 0.05 * static_cast<double>(stays));
    }
}

TEST(FrameRanges, AreTheSameHoweverTheyWereMade) {
    for (const LightKind kind : {LightKind::directional, LightKind::point}) {
        const MovingTriangles scene = small_scene(kind);
        for (const char* method : {"exact", "dtr"}) {
            RenderSettings settings;
            settings.method = method;
            const std::vector<TexelRange> expected = dumped(scene, settings).light_ranges.at(0).ranges;
            EXPECT_GT(expected.size(), 200u);
            const auto expect_same = [&](const std::string& how) {
                EXPECT_TRUE(dumped(scene, settings).light_ranges.at(0).ranges == expected) << method << ", " << how;
            };
            for (const std::string layout : {"array", "linked"}) {
                settings.layout = layout;
                expect_same(layout);
                settings.layout = std::string(GN_PATH(GNOMON_SOURCE_DIR)) + "/comp_shaders/layouts/" + layout;
                expect_same("folder of " + layout);
                settings.pages = "asked";
                expect_same(layout + ", asked");
                settings.pages = "auto";
                settings.layout = layout;
            }
        }
    }
}

/// Over a million of the small scene's, and a small picture.
RenderSettings many_ranges() {
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.spp = 1;
    settings.shadow_res = 2000;
    settings.keep_ranges = true;
    return settings;
}

// Bands, and windows; and many ranges to read.
TEST(FrameRanges, DoNotDependOnTheBudget) {
    const MovingTriangles scene = small_scene(LightKind::spot);
    RenderSettings settings = many_ranges();
    for (const std::string layout : {"array", "linked"}) {
        settings.layout = layout;
        settings.memory_budget = 0;
        const Frame expected = validated_renderer().render(scene.scene, scene.poses, settings);
        EXPECT_GT(expected.light_ranges.at(0).ranges.size(), 1'000'000u);
        settings.memory_budget = 48u << 20;
        const Frame frame = validated_renderer().render(scene.scene, scene.poses, settings);
        EXPECT_LE(frame.stats.peak_bytes, settings.memory_budget);
        EXPECT_GT(expected.stats.peak_bytes, settings.memory_budget * 3 / 2);
        EXPECT_TRUE(frame.light_ranges.at(0).ranges == expected.light_ranges.at(0).ranges) << layout;
    }
}

uint64_t fills(const Frame& frame) {
    uint64_t dispatches = 0;
    for (const FrameStats::Stage& stage : frame.stats.stages) dispatches += stage.name == "raster/fill" ? stage.dispatches : 0;
    return dispatches;
}

// Where a binding holds less than the ranges, a band is written in parts, the places of each bound from its own first on.
TEST(FrameRanges, DoNotDependOnWhatADeviceBinds) {
    const MovingTriangles scene = small_scene(LightKind::spot);
    RenderSettings settings = many_ranges();
    setenv("GNOMON_LIMITS", "storage_range=8388608", 1);
    Renderer limited("", true);
    unsetenv("GNOMON_LIMITS");
    for (const auto& [method, layout] : {std::pair("exact", "linked"), std::pair("dtr-analytic", "array")}) {
        settings.method = method;
        settings.layout = layout;
        const Frame expected = validated_renderer().render(scene.scene, scene.poses, settings);
        const Frame frame = limited.render(scene.scene, scene.poses, settings);
        EXPECT_GT(fills(frame), fills(expected));
        EXPECT_TRUE(frame.light_ranges.at(0).ranges == expected.light_ranges.at(0).ranges) << method << ", " << layout;
    }
}

TEST(FrameRanges, OfMethodsWithoutThemAreEmpty) {
    RenderSettings settings;
    settings.method = "tsm";
    const Frame frame = dumped(small_scene(LightKind::spot), settings);
    EXPECT_EQ(frame.light_ranges.at(0).width, 0u);
    EXPECT_TRUE(frame.light_ranges.at(0).ranges.empty());
    EXPECT_TRUE(frame.texel_ranges.at(0).empty());
}

/// What another reader than gnomon's finds: a map of channels, one value behind the other, and the samples of each pixel.
struct DeepImage {
    std::vector<uint32_t> counts;
    std::map<std::string, std::vector<float>> channels;
};

DeepImage read_deep(const std::filesystem::path& path) {
    Imf::DeepScanLineInputFile file(path.c_str());
    const Imf::Header& header = file.header();
    EXPECT_EQ(header.compression(), Imf::ZIPS_COMPRESSION);
    const Imath::Box2i window = header.dataWindow();
    const size_t width = window.max.x + 1, height = window.max.y + 1;
    DeepImage image;
    image.counts.resize(width * height);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(image.counts.data()), sizeof(uint32_t), sizeof(uint32_t) * width));
    std::map<std::string, std::vector<float*>> places;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        EXPECT_EQ(channel.channel().type, Imf::FLOAT) << channel.name();
        std::vector<float*>& at = places[channel.name()];
        at.resize(width * height);
        buffer.insert(channel.name(), Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(at.data()), sizeof(float*),
                                                     sizeof(float*) * width, sizeof(float)));
    }
    file.setFrameBuffer(buffer);
    file.readPixelSampleCounts(0, window.max.y);
    size_t total = 0;
    for (const uint32_t count : image.counts) total += count;
    for (auto& [name, at] : places) {
        image.channels[name].resize(total);
        float* next = image.channels[name].data();
        for (size_t i = 0; i < at.size(); next += image.counts[i++]) at[i] = next;
    }
    file.readPixels(0, window.max.y);
    return image;
}

class FrameRangesFile : public TestFolder {};

TEST_F(FrameRangesFile, ComeBackFromADeepImage) {
    for (const std::string method : {"exact", "dtr-analytic"}) {
        RenderSettings settings;
        settings.method = method;
        const LightRanges light = dumped(small_scene(LightKind::point), settings).light_ranges.at(0);
        io::write_sbuffer(folder / "a.exr", light, {{"gnomon:light", "0"}});
        DeepImage image = read_deep(folder / "a.exr");
        std::vector<std::string> names = {"A", "Z", "ZBack", "time.enter", "time.exit", "triangle"};
        if (method != "exact") names.insert(names.begin() + 3, {"depth.enter", "depth.exit"});
        std::vector<std::string> found;
        for (const auto& [name, values] : image.channels) found.push_back(name);
        std::sort(names.begin(), names.end());
        EXPECT_EQ(found, names);
        std::vector<uint32_t> counts(size_t(light.width) * light.height);
        uint64_t wrong = 0, turned = 0;
        ASSERT_EQ(image.channels["Z"].size(), light.ranges.size());
        for (size_t i = 0; i < light.ranges.size(); ++i) {
            const TexelRange& r = light.ranges[i];
            ++counts.at(r.texel);
            turned += r.exit_depth < r.depth ? 1 : 0;
            const bool same = image.channels["Z"][i] == std::min(r.depth, r.exit_depth) &&
                              image.channels["ZBack"][i] == std::max(r.depth, r.exit_depth) &&
                              image.channels["time.enter"][i] == r.enter && image.channels["time.exit"][i] == r.leave &&
                              image.channels["triangle"][i] == static_cast<float>(r.triangle) && image.channels["A"][i] == 1.0f;
            const bool depths = method == "exact" || (image.channels["depth.enter"][i] == r.depth &&
                                                      image.channels["depth.exit"][i] == r.exit_depth);
            wrong += same && depths ? 0 : 1;
        }
        EXPECT_EQ(image.counts, counts);
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(turned > 0, method != "exact");  // Triangles that come nearer.
        const io::SBufferSummary summary = io::check_sbuffer(io::SBufferFile(folder / "a.exr"));
        EXPECT_EQ(summary.ranges, light.ranges.size());
        EXPECT_EQ(summary.triangles, 3u);
    }
}

}  // namespace
}  // namespace gnomon::test
