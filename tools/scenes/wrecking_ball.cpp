// SPDX-License-Identifier: Apache-2.0
// The scene wrecking-ball, after that of Andersson et al. 2015 (Fig. 14).
#include "common.hpp"
#include "figure_motion.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

const Rgb kWood = from_srgb(222, 178, 118), kPale = from_srgb(240, 210, 162);

/// A turned piece of wood from one joint to the next, thickest at `belly` of its length.
Mesh limb(Vec3 from, Vec3 to, double thickness, double belly, uint32_t triangles) {
    const Vec3 axis = normalized(to - from), side = normalized(cross(axis, {0.9, 0.3, 0.1})), front = cross(axis, side);
    const Cut cut = cut_for(triangles, length(to - from) / (6.0 * thickness));
    std::vector<Ring> rings;
    for (uint32_t r = 1; r <= cut.rings; ++r) {
        const double at = 0.5 - 0.5 * std::cos(kPi * r / (cut.rings + 1));
        const double t = at < belly ? at / belly : (1.0 - at) / (1.0 - belly);
        const double width = thickness * std::sqrt(1.0 - (1.0 - t) * (1.0 - t));
        rings.push_back({from + (to - from) * at, side * width, front * width});
    }
    return tube(from, rings, to, cut.sides);
}

/// A jointed wooden doll on the figure's skeleton, each part bound to one joint.
Mesh doll(uint32_t triangles) {
    struct Part {
        Joint joint;
        Vec3 from, to;
        double thickness, belly;
    };
    const auto& skeleton = figure_skeleton();
    const auto at = [&](int joint) { return skeleton[static_cast<std::size_t>(joint)].position; };
    std::vector<Part> parts = {{pelvis, {0, 0.86, 0}, {0, 1.06, 0}, 0.15, 0.4},
                               {spine, {0, 1.03, 0}, {0, 1.24, 0}, 0.1, 0.5},
                               {chest, {0, 1.17, 0}, {0, 1.5, 0}, 0.19, 0.62},
                               {neck, {0, 1.44, 0}, {0, 1.56, 0}, 0.045, 0.5},
                               {head, {0, 1.52, 0}, {0, 1.79, 0}, 0.105, 0.55}};
    for (const int side : {0, static_cast<int>(kSide)}) {
        const auto add = [&](int joint, Vec3 to, double thickness, double belly) {
            parts.push_back({static_cast<Joint>(joint + side), at(joint + side), to, thickness, belly});
        };
        const Vec3 hand = at(left_hand + side), toes = at(left_toes + side);
        add(left_upper_arm, at(left_forearm + side), 0.055, 0.3);
        add(left_forearm, hand, 0.048, 0.35);
        add(left_hand, hand + (hand - at(left_forearm + side)) * 0.75, 0.04, 0.5);
        add(left_thigh, at(left_shin + side), 0.085, 0.3);
        add(left_shin, at(left_foot + side), 0.065, 0.3);
        add(left_foot, toes + Vec3{0.1, 0.025, 0.0}, 0.045, 0.6);
    }
    const auto share = static_cast<uint32_t>(static_cast<double>(triangles) / static_cast<double>(parts.size()));
    Mesh mesh;
    for (const Part& part : parts) {
        Mesh piece = limb(part.from, part.to, part.thickness, part.belly, share * 7 / 10);
        piece.paint(bytes_of(kWood));
        Mesh ball = sphere(std::min(0.06, 0.8 * part.thickness), cut_for(share * 3 / 10, 0.5));
        ball.map([&](Vec3 p) { return p + part.from; });
        ball.paint(bytes_of(kPale));
        for (Mesh* each : {&piece, &ball}) {
            each->bind(part.joint);
            mesh.append(*each);
        }
    }
    return mesh;
}

/// It stands in the way, throws up its arms and leans back: the hands move almost half a metre in the first shutter.
Posture fright_at(double seconds) {
    static constexpr Key kArms[] = {{-0.05, 0.4}, {0.07, 2.5}, {1.0, 2.7}};
    static constexpr Key kLean[] = {{-0.05, 0.0}, {0.12, 0.75}, {1.0, 0.9}};
    const double arms = eased(kArms, seconds), lean = eased(kLean, seconds);
    Posture posture;
    posture.rotations[pelvis] = about_z(0.2 * lean);
    posture.rotations[spine] = about_z(0.4 * lean);
    posture.rotations[chest] = about_z(0.4 * lean);
    posture.rotations[head] = about_z(-0.3 * lean);
    pose_arm(posture, 0, arms, 0.5, 0.3, 0.35);
    pose_arm(posture, kSide, arms, 0.5, 0.3, 0.35);
    const auto& skeleton = figure_skeleton();
    posture.pelvis_position = skeleton[pelvis].position + Vec3{-0.1 * lean, -0.1 - 0.04 * lean, 0.0};
    const auto world = world_of(posture);
    for (const int side : {0, static_cast<int>(kSide)}) {
        const double step = side == 0 ? -0.3 : 0.12;
        const Vec3 ankle = skeleton[static_cast<std::size_t>(left_foot + side)].position + Vec3{step, 0.0, 0.0};
        reach(posture, side, world[static_cast<std::size_t>(left_thigh + side)].position, ankle, 0.0);
    }
    return posture;
}

Motion fright() {
    Motion motion;
    motion.seconds = key_times(1.0, 96);
    for (const double seconds : motion.seconds) {
        motion.postures.push_back(fright_at(seconds));
        motion.pelvis_positions.push_back(motion.postures.back().pelvis_position);
    }
    motion.pelvis_seconds = motion.seconds;
    return motion;
}

constexpr double kChain = 4.6, kBallRadius = 0.42;

/// Links that hang from the origin, every other one turned by a right angle.
Mesh chain(uint32_t triangles) {
    constexpr double kPitch = 0.2, kWire = 0.022, kHalfWidth = 0.055;
    constexpr int kLinks = static_cast<int>((kChain - kBallRadius) / kPitch);
    const Cut cut = cut_for(triangles / kLinks, 3.0);
    Mesh links;
    for (int link = 0; link < kLinks; ++link) {
        const Quat turn = axis_angle({0, 1, 0}, link % 2 * kPi / 2.0 + kPi / 4.0);
        const Vec3 center{0.0, -kPitch * (link + 0.5), 0.0};
        std::vector<Ring> rings;
        for (uint32_t r = 0; r < cut.rings; ++r) {
            const double angle = 2.0 * kPi * r / cut.rings;
            const Vec3 outward = rotate(turn, {std::cos(angle), std::sin(angle), 0.0});
            const Vec3 offset = rotate(turn, {kHalfWidth * std::cos(angle), (kPitch / 2.0 + kWire) * std::sin(angle), 0.0});
            rings.push_back({center + offset, outward * kWire, rotate(turn, {0.0, 0.0, -kWire})});
        }
        links.append(closed_loop(rings, cut.sides));
    }
    return links;
}

/// An iron ball with a collar, about the origin.
Mesh iron_ball(uint32_t triangles) {
    std::vector<ProfilePoint> profile;
    constexpr int kSteps = 24;
    for (int i = 1; i < kSteps; ++i) {
        const double angle = kPi * i / kSteps;
        profile.push_back({kBallRadius * std::sin(angle), -kBallRadius * std::cos(angle)});
    }
    profile.push_back({0.08, kBallRadius + 0.01});
    profile.push_back({0.07, kBallRadius + 0.1});
    return lathe(profile, triangles);
}

}  // namespace

void make_wrecking_ball(const std::filesystem::path& path, const WreckingBallOptions& options) {
    require_range("triangles", options.triangles, 4000, 1e6);
    const auto share = [&](double of_all) { return static_cast<uint32_t>(std::lround(of_all * options.triangles)); };
    GltfWriter writer("wrecking-ball");
    add_studio(writer, 0.25);
    add_figure(writer, "doll", doll(share(0.55)), fright());

    // Ball and chain are one pendulum about a point over the doll; at 0 s it is nearly at its lowest and fastest.
    constexpr double kAmplitude = 1.1, kPeriod = 2.0, kFirstAngle = 0.26;
    const Vec3 pivot{0.0, kChain + 1.35, 0.0};
    const int pendulum = writer.add_node("pendulum", {pivot, about_z(kFirstAngle)});
    const Mesh links = chain(share(0.22)), ball = iron_ball(share(0.22));
    const Primitive steel{&links, writer.add_material("chain", from_srgb(150, 150, 156))};
    const Primitive iron{&ball, writer.add_material("ball", from_srgb(92, 96, 108))};
    writer.add_mesh_node("chain", writer.add_mesh("chain", {&steel, 1}), {}, pendulum);
    writer.add_mesh_node("ball", writer.add_mesh("ball", {&iron, 1}), {{0.0, -kChain, 0.0}, {}}, pendulum);
    const std::vector<double> seconds = key_times(kPeriod, 96);
    std::vector<Quat> rotations;
    for (const double s : seconds) {
        const double phase = std::asin(kFirstAngle / kAmplitude) - 2.0 * kPi * s / kPeriod;
        rotations.push_back(about_z(kAmplitude * std::sin(phase)));
    }
    writer.animate_rotation(pendulum, writer.add_times(seconds), rotations);

    writer.add_camera("camera", {1.4, 1.7, 5.2}, {0.45, 1.2, 0.0}, 0.6, 16.0 / 9.0, 0.1, 100.0);
    writer.add_spot_light("light", looking_at({4.2, 6.2, 3.2}, {0.6, 0.9, -0.8}), {1.0, 0.96, 0.9}, 260.0, 0.5, 0.85);
    if (options.fill_light) add_fill_light(writer, {0.3, -0.7, -0.8});
    writer.write(path);
}

}  // namespace gnomon::makers
