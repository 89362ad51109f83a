// SPDX-License-Identifier: Apache-2.0
// Colours and channels against numbers worked out by hand.
#include <gtest/gtest.h>

#include "shapes.hpp"
#include "support/paths.hpp"

namespace gnomon::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// sRGB-encoded bytes in linear light.
constexpr float kByte64 = 0.0512695f, kByte128 = 0.2158605f, kByte188 = 0.5028865f;

// A camera that sees the square |x|, |y| <= half_size of the plane z = 0, and the quad there with the image's way of texture
// coordinates: (0, 0) at the upper left, (1, 1) at the lower right.
MovingTriangles canvas(float half_size = 1.0f) {
    MovingTriangles scene(1);
    add_quad(scene, {-1.0f, 1.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, -2.0f, 0.0f});
    scene.add(orthographic(half_size), {{{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.0}}});
    return scene;
}

// Straight onto the canvas: a white surface reflects 1.
void add_straight_sun(MovingTriangles& scene) { scene.add(sun(kPi), {{{}, {1.0, 0.0, 0.0, 0.0}}}); }

void set_texture(MovingTriangles& scene, uint32_t width, uint32_t height, std::vector<uint8_t> rgba, Wrap u, Wrap v) {
    Image image;
    image.width = width;
    image.height = height;
    image.rgba = std::move(rgba);
    scene.scene.images = {image};
    scene.scene.materials[0].image = 0;
    scene.scene.materials[0].wrap_u = u;
    scene.scene.materials[0].wrap_v = v;
}

struct Picture {
    explicit Picture(const PosedScene& posed, uint32_t size = 8, uint32_t spp = 4)
        : size_px(size), frame(shared_renderer().render(posed.scene, posed.poses, small_settings(size, size, spp, 32))) {}
    glm::vec3 at(uint32_t x, uint32_t y) const {
        const size_t i = size_t{y} * size_px + x;
        return {frame.channels[0].values[i], frame.channels[1].values[i], frame.channels[2].values[i]};
    }
    uint32_t size_px;
    Frame frame;
};

void expect_colour(const glm::vec3& got, const glm::vec3& expected) {
    for (glm::length_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(got[i], expected[i], 2e-4f * std::abs(expected[i]) + 1e-5f)
            << "channel " << i << " of (" << got.x << " " << got.y << " " << got.z << ")";
    }
}

glm::vec3 colour_of(const PosedScene& posed) { return Picture(posed, 2, 4).at(0, 0); }

TEST(Textures, LieTheRightWayRound) {
    // Red, green / blue, grey. Clamped, the outer quarters of the canvas are of one texel each.
    MovingTriangles scene = canvas();
    add_straight_sun(scene);
    set_texture(scene, 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 188, 188, 188, 255}, Wrap::clamp_to_edge,
                Wrap::clamp_to_edge);
    const Picture picture(scene);
    expect_colour(picture.at(0, 0), {1.0f, 0.0f, 0.0f});
    expect_colour(picture.at(1, 1), {1.0f, 0.0f, 0.0f});
    expect_colour(picture.at(7, 0), {0.0f, 1.0f, 0.0f});
    expect_colour(picture.at(0, 7), {0.0f, 0.0f, 1.0f});
    expect_colour(picture.at(7, 7), glm::vec3(kByte188));
    // In between, bilinear in linear light: the sum of red, green, blue and 4 times grey, at the middle of all.
    const glm::vec3 middle = 0.25f * (picture.at(3, 3) + picture.at(4, 3) + picture.at(3, 4) + picture.at(4, 4));
    EXPECT_NEAR(middle.x, 0.25f * (1.0f + kByte188), 0.1f);
    EXPECT_GT(picture.at(3, 0).x, picture.at(4, 0).x);
    EXPECT_GT(picture.at(0, 3).x, picture.at(0, 4).x);
}

// The image of 4 x 3 texels: red grows by column (0, 64, 128, 188), green by row (0, 128, 255), blue marks the texel at column
// 3, row 1.
std::vector<uint8_t> asymmetric_image() {
    std::vector<uint8_t> rgba;
    const uint8_t reds[] = {0, 64, 128, 188}, greens[] = {0, 128, 255};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            const bool marked = row == 1 && column == 3;
            rgba.insert(rgba.end(), {reds[column], greens[row], static_cast<uint8_t>(marked ? 255 : 0), 255});
        }
    }
    return rgba;
}

struct Lookup {
    glm::vec2 uv;
    Wrap u, v;
    glm::vec3 expected;
};

TEST(Textures, WrapAsWorkedOutByHand) {
    constexpr Wrap kRepeat = Wrap::repeat, kClamp = Wrap::clamp_to_edge, kMirror = Wrap::mirrored_repeat;
    const float row0 = 0.5f / 3.0f, row1 = 0.5f, row2 = 2.5f / 3.0f;  // v of the rows' centres.
    const float reds[] = {0.0f, kByte64, kByte128, kByte188};
    const Lookup lookups[] = {
        // Texel centres.
        {{0.125f, row0}, kRepeat, kRepeat, {reds[0], 0.0f, 0.0f}},
        {{0.375f, row1}, kRepeat, kRepeat, {reds[1], kByte128, 0.0f}},
        {{0.875f, row1}, kClamp, kClamp, {reds[3], kByte128, 1.0f}},
        {{0.625f, row2}, kMirror, kMirror, {reds[2], 1.0f, 0.0f}},
        // Halfway between two columns, and a quarter of the way between two rows.
        {{0.5f, row0}, kRepeat, kRepeat, {0.5f * (reds[1] + reds[2]), 0.0f, 0.0f}},
        {{0.125f, row1 + 0.25f / 3.0f}, kRepeat, kRepeat, {0.0f, 0.75f * kByte128 + 0.25f, 0.0f}},
        // Across the border: repeat mixes with the other end, clamp and mirror stay.
        {{0.0f, row0}, kRepeat, kRepeat, {0.5f * (reds[0] + reds[3]), 0.0f, 0.0f}},
        {{0.0f, row0}, kClamp, kRepeat, {reds[0], 0.0f, 0.0f}},
        {{1.0f, row0}, kMirror, kRepeat, {reds[3], 0.0f, 0.0f}},
        {{0.125f, 0.0f}, kRepeat, kRepeat, {0.0f, 0.5f, 0.0f}},
        {{0.125f, 0.0f}, kRepeat, kClamp, {0.0f, 0.0f, 0.0f}},
        {{0.125f, 1.0f}, kRepeat, kMirror, {0.0f, 1.0f, 0.0f}},
        // Outside of [0, 1].
        {{2.375f, row1 - 3.0f}, kRepeat, kRepeat, {reds[1], kByte128, 0.0f}},
        {{-0.375f, row0}, kRepeat, kRepeat, {reds[2], 0.0f, 0.0f}},
        {{-5.0f, 7.0f}, kClamp, kClamp, {reds[0], 1.0f, 0.0f}},
        {{9.0f, row1}, kClamp, kRepeat, {reds[3], kByte128, 1.0f}},
        {{-0.375f, row0}, kMirror, kRepeat, {reds[1], 0.0f, 0.0f}},
        {{1.125f, row0}, kMirror, kRepeat, {reds[3], 0.0f, 0.0f}},
        {{2.125f, row0}, kMirror, kRepeat, {reds[0], 0.0f, 0.0f}},
        {{0.125f, 1.0f + row0}, kRepeat, kMirror, {0.0f, 1.0f, 0.0f}},
        {{0.125f, -1.0f - row0}, kRepeat, kMirror, {0.0f, 1.0f, 0.0f}},
    };
    for (const Lookup& lookup : lookups) {
        SCOPED_TRACE(testing::Message() << "u " << lookup.uv.x << ", v " << lookup.uv.y << ", wrap "
                                        << static_cast<int>(lookup.u) << " " << static_cast<int>(lookup.v));
        MovingTriangles scene = canvas();
        add_straight_sun(scene);
        set_texture(scene, 4, 3, asymmetric_image(), lookup.u, lookup.v);
        for (Vertex& vertex : scene.scene.vertices) vertex.uv = lookup.uv;
        expect_colour(colour_of(scene), lookup.expected);
    }
}

TEST(Textures, EachMaterialHasItsOwn) {
    MovingTriangles scene = canvas();
    add_straight_sun(scene);
    set_texture(scene, 1, 1, {255, 0, 0, 255}, Wrap::repeat, Wrap::repeat);
    Image other;
    other.width = other.height = 1;
    other.rgba = {0, 0, 255, 255};
    scene.scene.images.push_back(other);
    Material second;
    second.image = 1;
    second.base_color = {0.5f, 0.5f, 0.5f, 1.0f};
    Material plain;
    plain.base_color = {0.0f, 0.25f, 0.0f, 1.0f};
    scene.scene.materials.insert(scene.scene.materials.end(), {second, plain});
    expect_colour(colour_of(scene), {1.0f, 0.0f, 0.0f});
    for (Triangle& triangle : scene.scene.triangles) triangle.material = 1;
    expect_colour(colour_of(scene), {0.0f, 0.0f, 0.5f});
    for (Triangle& triangle : scene.scene.triangles) triangle.material = 2;
    expect_colour(colour_of(scene), {0.0f, 0.25f, 0.0f});
}

TEST(Shading, VertexColoursAreInterpolatedAndMultiplied) {
    MovingTriangles scene = canvas();
    add_straight_sun(scene);
    scene.scene.materials[0].base_color = {1.0f, 0.5f, 0.25f, 1.0f};
    for (Vertex& vertex : scene.scene.vertices) {
        const glm::vec2 place = 0.5f * (glm::vec2(vertex.position) + 1.0f);
        vertex.color = {place.x, place.y, 1.0f, 1.0f};
    }
    constexpr uint32_t kSize = 8, kSpp = 4;
    const Picture picture(scene, kSize, kSpp);
    for (uint32_t pixel = 0; pixel < kSize * kSize; ++pixel) {
        glm::dvec2 mean(0.0);
        for (uint32_t s = 0; s < kSpp; ++s) {
            const oracle::SamplePoint p = sample_at(size_t{pixel} * kSpp + s, kSize, kSpp, 0);
            mean += glm::dvec2(p.x, kSize - p.y) / double(kSize * kSpp);
        }
        expect_colour(picture.at(pixel % kSize, pixel / kSize), {mean.x, 0.5 * mean.y, 0.25f});
    }
}

TEST(Shading, DirectionalLightIsInLux) {
    MovingTriangles scene = canvas();
    Light light = sun(3.0f * kPi);
    light.color = {1.0f, 0.5f, 2.0f};
    scene.add(light, {{{}, glm::angleAxis(std::numbers::pi / 3, glm::dvec3(0.0, 1.0, 0.0))}});  // Cosine 0.5.
    scene.scene.materials[0].base_color = {0.2f, 0.4f, 0.6f, 1.0f};
    // albedo / pi * lux * cosine.
    expect_colour(colour_of(scene), {0.2f * 3.0f * 0.5f, 0.4f * 0.5f * 3.0f * 0.5f, 0.6f * 2.0f * 3.0f * 0.5f});

    // Normals of the vertices, turned toward the viewer, instead of the triangle's: the cosine becomes 1.
    for (Vertex& vertex : scene.scene.vertices) vertex.normal = -glm::vec3(std::sqrt(0.75f), 0.0f, 0.5f);
    expect_colour(colour_of(scene), {0.6f, 0.6f, 3.6f});

    add_quad(scene, {-50.0f, -50.0f, 5.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 100.0f, 0.0f});  // Behind the camera: a shadow.
    expect_colour(colour_of(scene), glm::vec3(0.0f));
}

TEST(Shading, LightFromBehindTheSurfaceIsNotReflected) {
    MovingTriangles scene = canvas();
    scene.add(sun(kPi), {{{}, glm::dquat(0.0, 0.0, 1.0, 0.0)}});
    const Picture picture(scene);
    expect_colour(picture.at(3, 3), glm::vec3(0.0f));
    for (const float v : channel(picture.frame, "visibility.0")) EXPECT_EQ(v, 1.0f);  // The cosine plays no part.
}

TEST(Shading, SpotIsInCandelaWithinItsCone) {
    MovingTriangles scene = canvas(1e-5f);
    scene.add(spot(0.6f, 0.3f, 8.0f * kPi), {{{0.0, 0.0, 2.0}, {1.0, 0.0, 0.0, 0.0}}});
    expect_colour(colour_of(scene), glm::vec3(8.0f / 4.0f));  // Inverse square.

    scene.scene.lights[0].range = 4.0f;  // The window is 1 - (2 / 4)^4.
    expect_colour(colour_of(scene), glm::vec3(2.0f * 15.0f / 16.0f));
    scene.scene.lights[0].range = 0.0f;

    // The axis turned away: full inside the inner cone, squared in the smooth border, nothing outside, where visibility is 1.
    const auto turned = [&](double angle) {
        for (Pose& pose : scene.poses) pose.lights[0].rotation = glm::angleAxis(angle, glm::dvec3(0.0, 1.0, 0.0));
        return colour_of(scene);
    };
    expect_colour(turned(0.29), glm::vec3(2.0f));
    const float cone = (std::cos(0.5f) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    expect_colour(turned(0.5), glm::vec3(2.0f * cone * cone));
    expect_colour(turned(0.61), glm::vec3(0.0f));
    add_quad(scene, {-50.0f, -50.0f, 1.5f}, {100.0f, 0.0f, 0.0f}, {0.0f, 100.0f, 0.0f});  // Behind the camera: a shadow.
    EXPECT_EQ(channel(Picture(scene, 2).frame, "visibility.0")[0], 1.0f);
    turned(0.5);
    EXPECT_EQ(channel(Picture(scene, 2).frame, "visibility.0")[0], 0.0f);
}

TEST(Shading, PointLightIsInCandelaAllAround) {
    MovingTriangles scene = canvas(1e-5f);
    Light point;
    point.kind = LightKind::point;
    point.intensity = 8.0f * kPi;
    point.color = {1.0f, 0.5f, 0.25f};
    const auto lit_from = [&](const glm::dvec3& place) {
        scene.scene.lights.clear();
        for (Pose& pose : scene.poses) pose.lights.clear();
        scene.add(point, {{place, glm::angleAxis(2.0, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)))}});
        return colour_of(scene);
    };
    expect_colour(lit_from({0.0, 0.0, 2.0}), {2.0f, 1.0f, 0.5f});  // Inverse square.
    // 3, 4, 5: the cosine is 0.6, the distance 5.
    expect_colour(lit_from({4.0, 0.0, 3.0}), 8.0f / 25.0f * 0.6f * point.color);
    point.range = 4.0f;  // The window is 1 - (2 / 4)^4.
    expect_colour(lit_from({0.0, 0.0, 2.0}), 15.0f / 16.0f * glm::vec3(2.0f, 1.0f, 0.5f));
    expect_colour(lit_from({0.0, 0.0, 4.1}), glm::vec3(0.0f));
    expect_colour(lit_from({0.0, 0.0, -2.0}), glm::vec3(0.0f));  // Behind the canvas.
}

TEST(Shading, LightsAddUp) {
    MovingTriangles scene = canvas();
    add_straight_sun(scene);
    add_straight_sun(scene);
    scene.scene.lights[1].color = {0.0f, 0.5f, 0.0f};
    expect_colour(colour_of(scene), {1.0f, 1.5f, 1.0f});
}

// The channels of cli.md from the samples that they sum up.
TEST(Channels, AreTheMeansOfTheSamples) {
    MovingTriangles scene = still_life(2);
    scene.add(spot(0.5f), {at({-3.0, 4.0, 2.0}, {0.0, 0.5, 0.0})});
    add_floor(scene, 40.0f, 1.0f);
    scene.poses.back().cameras[0].translation.y += 1.5;  // Some pixels see the background at times.
    constexpr uint32_t kSpp = 12;
    const Frame frame = sampled_frame(scene, small_settings(50, 40, kSpp));
    size_t mixed = 0;
    for (size_t pixel = 0; pixel < size_t{50} * 40; ++pixel) {
        double hits = 0.0, depth = 0.0, lit[2] = {};
        for (size_t s = 0; s < kSpp; ++s) {
            const SampleRecord& record = frame.samples[pixel * kSpp + s];
            if (record.triangle == SampleRecord::kMiss) continue;
            hits += 1.0;
            depth += record.depth;
            for (uint32_t light : {0u, 1u}) lit[light] += record.lit >> light & 1u;
        }
        mixed += hits > 0.0 && hits < kSpp;
        ASSERT_FLOAT_EQ(channel(frame, "A")[pixel], static_cast<float>(hits / kSpp));
        ASSERT_NEAR(channel(frame, "Z")[pixel], hits > 0.0 ? depth / hits : 0.0, 1e-5);
        for (uint32_t light : {0u, 1u}) {
            const double p = hits > 0.0 ? lit[light] / hits : 0.0;
            ASSERT_FLOAT_EQ(channel(frame, "visibility." + std::to_string(light))[pixel], static_cast<float>(p));
            ASSERT_NEAR(channel(frame, "visibility_var." + std::to_string(light))[pixel],
                        hits > 0.0 ? std::sqrt(p * (1.0 - p) / std::max(hits - 1.0, 1.0)) : 0.0, 1e-6);
        }
    }
    EXPECT_GT(mixed, 20u);
}

TEST(Channels, HaveTheNamesOfTheContract) {
    MovingTriangles scene = canvas();
    add_straight_sun(scene);
    add_straight_sun(scene);
    std::vector<std::string> names;
    for (const Channel& c : Picture(scene).frame.channels) names.push_back(c.name);
    EXPECT_EQ(names, (std::vector<std::string>{"R", "G", "B", "A", "Z", "visibility.0", "visibility_var.0", "visibility.1",
                                               "visibility_var.1"}));
}

// The whole shading, textures included, against the reference's channels.
TEST(Channels, AreThoseOfTheReference) {
    const PosedScene posed = load_posed(std::filesystem::path(GN_PATH(GNOMON_SOURCE_DIR)) / "scenes/figure.gltf");
    const RenderSettings settings = small_settings(120, 68, 8, 512);
    const Frame frame = sampled_frame(posed, settings);
    const Frame truth = reference_frame(posed, settings);
    for (const Channel& expected : truth.channels) {
        const std::vector<float>& values = channel(frame, expected.name);
        ASSERT_EQ(values.size(), expected.values.size());
        size_t different = 0;
        for (size_t i = 0; i < values.size(); ++i)
            different += std::abs(values[i] - expected.values[i]) > 1e-4f * (1.0f + expected.values[i]);
        EXPECT_LE(different, values.size() / 200) << expected.name;
    }
}

}  // namespace
}  // namespace gnomon::test
