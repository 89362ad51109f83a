// SPDX-License-Identifier: Apache-2.0
#include "known_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::cli {

namespace {

/// Metres, seen from above: x to the right of the picture, z down it.
struct Rectangle {
    double left, top, right, bottom;
};

constexpr uint32_t kSide = 48, kSpp = 64, kBlock = 8;
constexpr double kHalf = 2.0;  ///< Half the picture's side, metres.
constexpr double kCamera = 10.0, kHeight = 1.0;
constexpr Rectangle kGround{-1.73, -1.61, 1.81, 1.67};
constexpr Rectangle kFlying{-1.3, -0.9, -0.6, -0.3};  ///< At the first key.
constexpr glm::dvec2 kMotion{0.35, 1.1};              ///< To the last key, x and z.
/// The shadow's place beside what casts it, by metre of height. It is wider than the rectangle, which hides none of it.
constexpr glm::dvec2 kShadow{0.8, 0.1};
constexpr glm::vec3 kGroundColor{0.5f, 0.4f, 0.3f}, kFlyingColor{0.2f, 0.7f, 0.9f};

double sun_cosine() { return 1.0 / std::sqrt(1.0 + glm::dot(kShadow, kShadow)); }

void add_rectangle(Scene& scene, const Rectangle& r, double height, glm::vec3 color, uint32_t matrix) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    for (const auto& [x, z] : {std::pair(r.left, r.top), {r.left, r.bottom}, {r.right, r.bottom}, {r.right, r.top}}) {
        Vertex vertex;
        vertex.position = glm::vec3(x, height, z);
        vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
        vertex.influence_count = 1;
        scene.influences.push_back({matrix, 1.0f});
        scene.vertices.push_back(vertex);
    }
    const auto material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.emplace_back().base_color = glm::vec4(color, 1.0f);
    scene.triangles.push_back({{first, first + 1, first + 2}, material});
    scene.triangles.push_back({{first, first + 2, first + 3}, material});
}

/// Three rows of a matrix that moves by (x, 0, z).
void add_translation(Pose& pose, const glm::dvec2& by) {
    pose.palette.insert(pose.palette.end(), {{1, 0, 0, by.x}, {0, 1, 0, 0}, {0, 0, 1, by.y}});
}

/// The share of the shutter in which a point is in the flying rectangle, moved by `offset`.
double time_inside(const glm::dvec2& point, const glm::dvec2& offset) {
    const glm::dvec2 lower = glm::dvec2(kFlying.left, kFlying.top) + offset;
    const glm::dvec2 upper = glm::dvec2(kFlying.right, kFlying.bottom) + offset;
    const glm::dvec2 first = (point - upper) / kMotion, last = (point - lower) / kMotion;
    return std::max(0.0, std::min({1.0, last.x, last.y}) - std::max({0.0, first.x, first.y}));
}

/// How much of [from, to] is in [lower, upper].
double covered(double from, double to, double lower, double upper) {
    return std::max(0.0, std::min(to, upper) - std::max(from, lower)) / (to - from);
}

/// What a sample finds: one of these.
enum Find { kNothing, kLitGround, kDarkGround, kFlyingRectangle, kFinds };
using Finds = std::array<double, kFinds>;

/// How probable each is in a pixel. What flies and its shadow stay over the ground.
Finds probabilities(uint32_t column, uint32_t row) {
    constexpr double kWidth = 2.0 * kHalf / kSide;
    const double x = kWidth * column - kHalf, z = kWidth * row - kHalf;
    const double ground =
        covered(x, x + kWidth, kGround.left, kGround.right) * covered(z, z + kWidth, kGround.top, kGround.bottom);
    constexpr int kPoints = 16;  // Times inside are linear but for kinks.
    double flying = 0.0, dark = 0.0;
    for (int i = 0; i < kPoints * kPoints; ++i) {
        const glm::dvec2 point(x + kWidth * (i % kPoints + 0.5) / kPoints, z + kWidth * (i / kPoints + 0.5) / kPoints);
        flying += time_inside(point, glm::dvec2(0.0)) / (kPoints * kPoints);
        dark += time_inside(point, kHeight * kShadow) / (kPoints * kPoints);
    }
    return {1.0 - ground, ground - flying - dark, dark, flying};
}

/// A channel's values for each find.
struct KnownChannel {
    const char* name;
    bool of_hits;  ///< The frame has the mean over the hits.
    Finds values;
};

std::array<KnownChannel, 6> known_channels() {
    const double cosine = sun_cosine();
    const auto color = [&](const char* name, int i) {
        return KnownChannel{name, false, {0.0, cosine * kGroundColor[i], 0.0, cosine * kFlyingColor[i]}};
    };
    return {color("R", 0),
            color("G", 1),
            color("B", 2),
            KnownChannel{"A", false, {0.0, 1.0, 1.0, 1.0}},
            KnownChannel{"Z", true, {0.0, kCamera, kCamera, kCamera - kHeight}},
            KnownChannel{"visibility.0", true, {0.0, 1.0, 0.0, 1.0}}};
}

const std::vector<float>& values_of(const Frame& frame, const char* name) {
    return std::find_if(frame.channels.begin(), frame.channels.end(), [&](const Channel& c) { return c.name == name; })->values;
}

/// Of a block of pixels: how far the channel's mean is off.
WorstMean compare_block(const Frame& frame, const std::vector<Finds>& finds, const KnownChannel& channel, uint32_t left,
                        uint32_t top, uint32_t side) {
    const std::vector<float>&values = values_of(frame, channel.name), &hits = values_of(frame, "A");
    double sum = 0.0, expected = 0.0, variance = 0.0;
    for (uint32_t y = top; y < top + side; ++y) {
        for (uint32_t x = left; x < left + side; ++x) {
            const size_t i = size_t{y} * kSide + x;
            sum += channel.of_hits ? double{values[i]} * hits[i] : values[i];
            double mean = 0.0, square = 0.0;
            for (size_t f = 0; f < kFinds; ++f) {
                mean += finds[i][f] * channel.values[f];
                square += finds[i][f] * channel.values[f] * channel.values[f];
            }
            expected += mean;
            variance += std::max(0.0, square - mean * mean) / kSpp;
        }
    }
    const double pixels = static_cast<double>(side) * side;
    const double rounding = 1e-5 * *std::max_element(channel.values.begin(), channel.values.end());
    const double off = std::abs(sum - expected) / pixels - rounding, error = std::sqrt(variance) / pixels;
    // Written so that NaN is wrong.
    const double standard_errors = off <= 0.0 ? 0.0 : error > 0.0 ? off / error : std::numeric_limits<double>::infinity();
    return {std::string(channel.name) + (channel.of_hits ? " * A" : ""),
            left,
            top,
            left + side,
            top + side,
            sum / pixels,
            expected / pixels,
            std::isnan(standard_errors) ? std::numeric_limits<double>::infinity() : standard_errors};
}

}  // namespace

KnownPicture::KnownPicture() {
    scene.morphs.emplace_back();
    add_rectangle(scene, kGround, 0.0, kGroundColor, 0);
    add_rectangle(scene, kFlying, kHeight, kFlyingColor, 1);

    Camera camera;
    camera.kind = CameraKind::orthographic;
    camera.xmag = camera.ymag = kHalf;
    scene.cameras.push_back(camera);
    Light sun;
    sun.intensity = 3.14159265f;  // A white surface that faces it has radiance 1.
    scene.lights.push_back(sun);

    const glm::dquat down = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec3 shine = glm::normalize(glm::dvec3(kShadow.x, -1.0, kShadow.y));
    poses.resize(2);
    for (size_t key = 0; key < 2; ++key) {
        add_translation(poses[key], glm::dvec2(0.0));
        add_translation(poses[key], static_cast<double>(key) * kMotion);
        poses[key].cameras.push_back({{0.0, kCamera, 0.0}, down});
        poses[key].lights.push_back({{}, glm::quatLookAt(shine, glm::dvec3(0.0, 0.0, 1.0))});
    }
    settings.width = settings.height = kSide;
    settings.spp = kSpp;
    settings.shadow_res = 128;
}

WorstMean worst_mean(const Frame& frame) {
    std::vector<Finds> finds;
    for (uint32_t i = 0; i < kSide * kSide; ++i) finds.push_back(probabilities(i % kSide, i / kSide));
    WorstMean worst;
    const auto compare = [&](const KnownChannel& channel, uint32_t left, uint32_t top, uint32_t side) {
        WorstMean mean = compare_block(frame, finds, channel, left, top, side);
        if (worst.channel.empty() || mean.standard_errors > worst.standard_errors) worst = std::move(mean);
    };
    for (const KnownChannel& channel : known_channels()) {
        compare(channel, 0, 0, kSide);
        for (uint32_t top = 0; top < kSide; top += kBlock) {
            for (uint32_t left = 0; left < kSide; left += kBlock) compare(channel, left, top, kBlock);
        }
    }
    return worst;
}

}  // namespace gnomon::cli
