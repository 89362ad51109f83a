// SPDX-License-Identifier: Apache-2.0
// The figure's skeleton and body.
#include <algorithm>
#include <functional>

#include "common.hpp"
#include "figure.hpp"

namespace gnomon::makers {
namespace {

/// A cross-section of a body part, an ellipse `at` metres from the part's origin along its axis.
struct Section {
    double at;
    double half_width;
    double half_depth;   ///< Along the part's front.
    double shift = 0.0;  ///< Of the center, along the part's front.
};

/// `joint` rules the part from `at` on, blended with the joint before it over `blend` metres to either side.
struct Bone {
    double at;
    int joint;
    double blend = 0.0;
};

struct Part {
    Vec3 origin;
    Vec3 axis;
    Vec3 front;  ///< At right angles to the axis, unit length as well.
    std::vector<Section> sections;
    double first_cap, last_cap;  ///< Lengths of the rounded ends, metres.
    std::vector<Bone> bones;
    std::function<Rgb(double at, Vec3 position)> color;
    double area;              ///< Its share of the body's triangles.
    double aspect;            ///< Quads along over quads around.
    bool flat_below = false;  ///< Nothing is below y = 0.
};

const Rgb kSkin = from_srgb(222, 168, 134), kHair = from_srgb(66, 46, 40), kShirt = from_srgb(232, 118, 72),
          kTrousers = from_srgb(52, 92, 116), kShoes = from_srgb(238, 228, 210), kBelt = from_srgb(60, 52, 50),
          kSole = from_srgb(140, 60, 50);

/// Sections between the given ones, by cubic (Catmull-Rom) interpolation.
Section section_at(const std::vector<Section>& sections, double at) {
    std::size_t i = 0;
    while (i + 2 < sections.size() && sections[i + 1].at <= at) ++i;
    const Section& p1 = sections[i];
    const Section& p2 = sections[i + 1];
    const Section& p0 = i > 0 ? sections[i - 1] : p1;
    const Section& p3 = i + 2 < sections.size() ? sections[i + 2] : p2;
    const double width = p2.at - p1.at, t = (at - p1.at) / width;
    const auto blend = [&](double Section::*value) {
        const double v1 = p1.*value, v2 = p2.*value;
        const double m1 = i > 0 ? (v2 - p0.*value) / (p2.at - p0.at) * width : v2 - v1;
        const double m2 = i + 2 < sections.size() ? (p3.*value - v1) / (p3.at - p1.at) * width : v2 - v1;
        const double t2 = t * t, t3 = t2 * t;
        return v1 * (2.0 * t3 - 3.0 * t2 + 1.0) + m1 * (t3 - 2.0 * t2 + t) + v2 * (3.0 * t2 - 2.0 * t3) + m2 * (t3 - t2);
    };
    return {at, blend(&Section::half_width), blend(&Section::half_depth), blend(&Section::shift)};
}

/// Width of a rounded end, `distance` from it: the quarter of an ellipse that is `cap` long.
double rounding(double distance, double cap) {
    if (distance >= cap) return 1.0;
    const double rest = 1.0 - std::max(0.0, distance) / cap;
    return std::sqrt(1.0 - rest * rest);
}

double smoothstep(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

Mesh build(const Part& part, uint32_t triangles) {
    const Cut cut = cut_for(triangles, part.aspect, 2);
    const Vec3 side = cross(part.front, part.axis);
    const double start = part.sections.front().at, end = part.sections.back().at, reach = end - start;
    const auto center = [&](const Section& s) { return part.origin + part.axis * s.at + part.front * s.shift; };

    std::vector<double> along = {start};
    std::vector<Ring> rings;
    for (uint32_t r = 1; r <= cut.rings; ++r) {
        // Closer together toward the ends, which are round.
        const double share = static_cast<double>(r) / (cut.rings + 1);
        const double at = start + reach * (share - 0.8 * std::sin(2.0 * kPi * share) / (2.0 * kPi));
        const Section s = section_at(part.sections, at);
        const double width = rounding(at - start, part.first_cap) * rounding(end - at, part.last_cap);
        rings.push_back({center(s), side * (s.half_width * width), part.front * (s.half_depth * width)});
        along.insert(along.end(), cut.sides, at);
    }
    along.push_back(end);
    Mesh mesh = tube(center(part.sections.front()), rings, center(part.sections.back()), cut.sides);
    if (part.flat_below) {
        mesh.map([](Vec3 p) { return Vec3{p.x, std::max(p.y, 0.0), p.z}; });
        mesh.smooth_normals();
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        std::size_t i = 0;
        while (i + 1 < part.bones.size() && along[v] > part.bones[i + 1].at - part.bones[i + 1].blend) ++i;
        const Bone& bone = part.bones[i];
        const Bone& before = part.bones[i == 0 ? 0 : i - 1];
        const double share = i == 0 ? 1.0 : smoothstep((along[v] - bone.at + bone.blend) / (2.0 * bone.blend));
        mesh.bind_next(static_cast<uint16_t>(before.joint), static_cast<uint16_t>(bone.joint), share);
        mesh.colors.push_back(bytes_of(part.color(along[v], mesh.positions[v])));
    }
    return mesh;
}

constexpr Vec3 kForward{1, 0, 0}, kUp{0, 1, 0};

Part torso() {
    return {.origin = {},
            .axis = kUp,
            .front = kForward,
            .sections = {{0.825, 0.12, 0.085},
                         {0.88, 0.165, 0.112, -0.008},
                         {0.95, 0.165, 0.108, -0.008},
                         {1.08, 0.136, 0.088},
                         {1.2, 0.153, 0.1, 0.004},
                         {1.32, 0.176, 0.112, 0.006},
                         {1.4, 0.182, 0.1, -0.002},
                         {1.455, 0.125, 0.075, -0.012},
                         {1.5, 0.07, 0.06, -0.012}},
            .first_cap = 0.09,
            .last_cap = 0.03,
            .bones = {{0.0, pelvis}, {1.06, spine, 0.09}, {1.25, chest, 0.09}},
            .color = [](double at, Vec3) { return at < 0.975 ? kTrousers
                                                  : at < 1.0 ? kBelt
                                                             : kShirt; },
            .area = 0.22,
            .aspect = 0.9};
}

Part head_and_neck() {
    const auto color = [](double at, Vec3 p) {
        if (at < 1.475) return kShirt;
        const bool crown = at > 1.7 - 0.35 * std::max(0.0, p.x), back = p.x < -0.015 && at > 1.57;
        return crown || back ? kHair : kSkin;
    };
    return {.origin = {},
            .axis = kUp,
            .front = kForward,
            .sections = {{1.42, 0.06, 0.06, -0.012},
                         {1.49, 0.05, 0.052, -0.006},
                         {1.535, 0.052, 0.062, 0.012},
                         {1.57, 0.066, 0.084, 0.022},
                         {1.63, 0.076, 0.096, 0.014},
                         {1.69, 0.08, 0.1, 0.004},
                         {1.765, 0.075, 0.092}},
            .first_cap = 0.02,
            .last_cap = 0.085,
            .bones = {{0.0, chest}, {1.47, neck, 0.03}, {1.545, head, 0.03}},
            .color = color,
            .area = 0.16,
            .aspect = 1.0};
}

/// side: -1 left, 1 right.
Part arm(int side) {
    const int joint = side > 0 ? kSide : 0;
    return {.origin = figure_skeleton()[static_cast<std::size_t>(left_upper_arm + joint)].position,
            .axis = {0.0, -std::cos(kArmAngle), side * std::sin(kArmAngle)},
            .front = kForward,
            .sections = {{-0.06, 0.05, 0.05},
                         {0.0, 0.062, 0.062},
                         {0.1, 0.05, 0.054},
                         {0.2, 0.043, 0.048},
                         {0.28, 0.038, 0.041},
                         {0.35, 0.039, 0.043, 0.002},
                         {0.44, 0.032, 0.036},
                         {0.525, 0.022, 0.029},
                         {0.57, 0.021, 0.039, 0.004},
                         {0.63, 0.02, 0.044, 0.006},
                         {0.68, 0.015, 0.036, 0.004},
                         {0.725, 0.012, 0.028, 0.002}},
            .first_cap = 0.06,
            .last_cap = 0.03,
            .bones = {{-1.0, left_clavicle + joint},
                      {-0.01, left_upper_arm + joint, 0.045},
                      {0.28, left_forearm + joint, 0.05},
                      {0.53, left_hand + joint, 0.03}},
            .color = [](double at, Vec3) { return at < 0.22 ? kShirt : kSkin; },
            .area = 0.125,
            .aspect = 2.2};
}

Part leg(int side) {
    const int joint = side > 0 ? kSide : 0;
    return {.origin = figure_skeleton()[static_cast<std::size_t>(left_thigh + joint)].position,
            .axis = kUp * -1.0,
            .front = kForward,
            .sections = {{-0.07, 0.08, 0.09, -0.01},
                         {0.0, 0.09, 0.105, -0.008},
                         {0.12, 0.083, 0.094},
                         {0.27, 0.069, 0.078, 0.004},
                         {0.41, 0.056, 0.061, 0.006},
                         {0.52, 0.055, 0.06, -0.01},
                         {0.62, 0.051, 0.056, -0.012},
                         {0.74, 0.043, 0.047, -0.006},
                         {0.84, 0.038, 0.043}},
            .first_cap = 0.07,
            .last_cap = 0.03,
            .bones = {{-1.0, pelvis},
                      {0.02, left_thigh + joint, 0.07},
                      {0.42, left_shin + joint, 0.07},
                      {0.81, left_foot + joint, 0.03}},
            .color = [](double at, Vec3) { return at < 0.73 ? kTrousers : kSkin; },
            .area = 0.145,
            .aspect = 2.2};
}

Part shoe(int side) {
    const int joint = side > 0 ? kSide : 0;
    const Vec3 ankle = figure_skeleton()[static_cast<std::size_t>(left_foot + joint)].position;
    return {.origin = {ankle.x, 0.0, ankle.z},
            .axis = kForward,
            .front = kUp,
            .sections = {{-0.075, 0.036, 0.045, 0.045},
                         {-0.02, 0.042, 0.066, 0.045},
                         {0.04, 0.042, 0.06, 0.042},
                         {0.1, 0.046, 0.045, 0.034},
                         {0.15, 0.048, 0.037, 0.029},
                         {0.205, 0.04, 0.03, 0.026}},
            .first_cap = 0.035,
            .last_cap = 0.06,
            .bones = {{-1.0, left_foot + joint}, {0.12, left_toes + joint, 0.03}},
            .color = [](double, Vec3 p) { return p.y < 0.016 ? kSole : kShoes; },
            .area = 0.05,
            .aspect = 1.2,
            .flat_below = true};
}

}  // namespace

const std::array<JointInfo, kFigureJoints>& figure_skeleton() {
    static const std::array<JointInfo, kFigureJoints> skeleton = [] {
        const auto along_arm = [](double at) {
            return Vec3{0.0, 1.405 - at * std::cos(kArmAngle), -0.182 - at * std::sin(kArmAngle)};
        };
        std::array<JointInfo, kFigureJoints> joints = {{
            {"pelvis", -1, {0.0, 0.93, 0.0}},
            {"spine", pelvis, {0.0, 1.06, 0.0}},
            {"chest", spine, {0.0, 1.25, 0.0}},
            {"neck", chest, {-0.01, 1.47, 0.0}},
            {"head", neck, {0.0, 1.545, 0.0}},
            {"left clavicle", chest, {0.0, 1.42, -0.04}},
            {"left upper arm", left_clavicle, along_arm(0.0)},
            {"left forearm", left_upper_arm, along_arm(0.28)},
            {"left hand", left_forearm, along_arm(0.53)},
            {"left thigh", pelvis, {0.0, 0.9, -0.095}},
            {"left shin", left_thigh, {0.0, 0.48, -0.095}},
            {"left foot", left_shin, {0.0, 0.08, -0.095}},
            {"left toes", left_foot, {0.12, 0.02, -0.095}},
            {"right clavicle", chest, {}},
            {"right upper arm", right_clavicle, {}},
            {"right forearm", right_upper_arm, {}},
            {"right hand", right_forearm, {}},
            {"right thigh", pelvis, {}},
            {"right shin", right_thigh, {}},
            {"right foot", right_shin, {}},
            {"right toes", right_foot, {}},
        }};
        for (std::size_t j = right_clavicle; j < kFigureJoints; ++j) {
            const Vec3 left = joints[j - kSide].position;
            joints[j].position = {left.x, left.y, -left.z};
        }
        return joints;
    }();
    return skeleton;
}

Mesh figure_body(uint32_t triangles) {
    Mesh body;
    const auto add = [&](const Part& part) {
        body.append(build(part, static_cast<uint32_t>(std::lround(part.area * triangles))));
    };
    add(torso());
    add(head_and_neck());
    for (const int side : {-1, 1}) {
        add(arm(side));
        add(leg(side));
        add(shoe(side));
    }
    return body;
}

}  // namespace gnomon::makers
