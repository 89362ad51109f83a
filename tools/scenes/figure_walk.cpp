// SPDX-License-Identifier: Apache-2.0
// The figure's walk: the feet are led, the legs follow by inverse kinematics, the pelvis is raised so that the lower foot
// touches the ground.
#include <algorithm>
#include <cassert>

#include "figure.hpp"

namespace gnomon::makers {
namespace {

constexpr uint32_t kPostures = 30;     // Per second.
constexpr uint32_t kPelvisKeys = 480;  // Per second; the lower foot changes at an instant, which these keys must follow.
constexpr double kSpeed = 1.25;        // Metres per second, and per cycle.
constexpr double kStart = -0.35;       // Where the walk begins, metres.
constexpr double kStance = 0.6;        // Share of the cycle in which a foot is on the ground.
constexpr double kFootAhead = 0.30;    // Of the ankle before the hip when the heel strikes, metres.
constexpr double kFirstPhase = 0.92;   // Of the right foot at 0 s: in its swing, so that the first shutter shows it move.

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

Quat about_z(double angle) { return axis_angle(kZ, angle); }

/// A value that eases from one key to the next; phases rise from 0 to 1.
struct Key {
    double phase, value;
};
template <std::size_t N>
double eased(const Key (&keys)[N], double phase) {
    std::size_t i = 0;
    while (i + 2 < N && keys[i + 1].phase <= phase) ++i;
    const double t = (phase - keys[i].phase) / (keys[i + 1].phase - keys[i].phase);
    return keys[i].value + (keys[i + 1].value - keys[i].value) * t * t * (3.0 - 2.0 * t);
}

/// The foot's pitch in radians, toes up positive: heel strike, flat, heel off, toe off, swing, heel strike.
double foot_pitch(double phase) {
    static constexpr Key kKeys[] = {{0.0, 0.33}, {0.1, 0.0}, {0.36, 0.0}, {0.62, -0.95}, {0.88, 0.28}, {1.0, 0.33}};
    return eased(kKeys, phase);
}

double toe_pitch(double pitch) { return std::min(0.5, 0.6 * std::max(0.0, -pitch)); }

struct JointTransform {
    Vec3 position;
    Quat rotation;
};

std::array<JointTransform, kFigureJoints> world_of(const Posture& posture) {
    const auto& skeleton = figure_skeleton();
    std::array<JointTransform, kFigureJoints> world;
    world[pelvis] = {posture.pelvis_position, posture.rotations[pelvis]};
    for (std::size_t j = 1; j < kFigureJoints; ++j) {
        const auto parent = static_cast<std::size_t>(skeleton[j].parent);
        const Vec3 offset = skeleton[j].position - skeleton[parent].position;
        world[j] = {world[parent].position + rotate(world[parent].rotation, offset),
                    world[parent].rotation * posture.rotations[j]};
    }
    return world;
}

/// Height of the lowest vertex of one shoe over its ankle when the foot has this pitch.
double sole_below_ankle(const Mesh& body, const std::vector<uint32_t>& shoe, double pitch) {
    const auto& skeleton = figure_skeleton();
    Posture posture;
    posture.pelvis_position = skeleton[pelvis].position;
    posture.rotations[right_foot] = about_z(pitch);
    posture.rotations[right_toes] = about_z(toe_pitch(pitch));
    double lowest = 0.0;
    for (const Vec3& p : posed_vertices(body, posture, shoe)) lowest = std::min(lowest, p.y - skeleton[right_foot].position.y);
    return lowest;
}

/// Where the ankle is at this phase of its foot: x relative to the hips' mean position, y over the ground.
Vec3 ankle_at(const Mesh& body, const std::vector<uint32_t>& shoe, double phase) {
    // While the foot rolls, the point that it rolls about (heel, then ball) stays where it is on the ground.
    const auto roll = [](double pitch) {
        const Vec3 pivot = pitch > 0.0 ? Vec3{-0.06, -0.08, 0.0} : Vec3{0.12, -0.07, 0.0};
        return (pivot - rotate(about_z(pitch), pivot)).x;
    };
    const double pitch = foot_pitch(phase);
    const double strike = kFootAhead - roll(foot_pitch(0.0));
    const double height = -sole_below_ankle(body, shoe, pitch);
    if (phase < kStance) return {strike - kSpeed * phase + roll(pitch), height, 0.0};

    // In the swing: from where the foot left the ground to the next strike, at the speed of the ground at either end.
    const double t = (phase - kStance) / (1.0 - kStance);
    const double from = strike - kSpeed * kStance + roll(foot_pitch(kStance)), to = kFootAhead;
    const double slope = -kSpeed * (1.0 - kStance);
    const double x = from + (to - from) * t * t * (3.0 - 2.0 * t) + slope * t * (1.0 - t) * (1.0 - 2.0 * t);
    const double lift = 0.05 * std::sin(kPi * t) * std::sin(kPi * t);
    return {x, height + lift, 0.0};
}

/// Bend one leg so that the ankle is at `ankle`, in the plane z = hip's z.
void reach(Posture& posture, int side, Vec3 hip, Vec3 ankle, double pitch) {
    const auto& skeleton = figure_skeleton();
    const auto thigh = static_cast<std::size_t>(left_thigh + side), shin = thigh + 1, foot = thigh + 2, toes = thigh + 3;
    const double upper = length(skeleton[shin].position - skeleton[thigh].position);
    const double lower = length(skeleton[foot].position - skeleton[shin].position);
    const double dx = ankle.x - hip.x, dy = ankle.y - hip.y;
    const double distance = std::min(std::hypot(dx, dy), 0.9985 * (upper + lower));
    const double line = std::atan2(dx, -dy);
    const auto corner = [&](double a, double b) {  // Of the triangle, between side a and the line.
        return std::acos((a * a + distance * distance - b * b) / (2.0 * a * distance));
    };
    const double thigh_angle = line + corner(upper, lower), shin_angle = line - corner(lower, upper);
    posture.rotations[thigh] = conjugate(posture.rotations[pelvis]) * about_z(thigh_angle);
    posture.rotations[shin] = about_z(shin_angle - thigh_angle);
    posture.rotations[foot] = about_z(pitch - shin_angle);
    posture.rotations[toes] = about_z(toe_pitch(pitch));
}

void swing_arm(Posture& posture, int side, double forward) {
    const auto upper = static_cast<std::size_t>(left_upper_arm + side);
    const double outward = side == 0 ? 1.0 : -1.0;  // Rotation about +X that brings the arm to the body.
    posture.rotations[upper] = about_z(0.08 + 0.52 * forward) * axis_angle(kX, -outward * (kArmAngle - 0.12));
    posture.rotations[upper + 1] = about_z(0.55 + 0.3 * forward);
    posture.rotations[upper + 2] = about_z(0.1 + 0.1 * forward);
}

Posture posture_at(const Mesh& body, const std::vector<uint32_t>& shoe, double seconds) {
    const double cycle = seconds + kFirstPhase;
    const double turn = 2.0 * kPi * cycle;  // 0 at the strike of the right heel.
    const double right_ahead = std::cos(turn);
    Posture posture;
    posture.rotations[pelvis] = axis_angle(kY, 0.09 * right_ahead) * axis_angle(kX, 0.03 * std::sin(turn));
    posture.rotations[spine] = axis_angle(kY, -0.1 * right_ahead) * about_z(-0.06);
    posture.rotations[chest] = axis_angle(kY, -0.12 * right_ahead) * axis_angle(kX, -0.03 * std::sin(turn)) * about_z(-0.05);
    posture.rotations[neck] = axis_angle(kY, 0.06 * right_ahead) * about_z(0.05);
    posture.rotations[head] = axis_angle(kY, 0.07 * right_ahead) * about_z(0.03);
    swing_arm(posture, 0, right_ahead);
    swing_arm(posture, kSide, -right_ahead);

    // Lowest where both feet are on the ground.
    const double height = 0.896 - 0.018 * std::cos(2.0 * (turn - 0.1));
    posture.pelvis_position = {kStart + kSpeed * seconds, height, 0.0};
    const auto world = world_of(posture);
    for (const int side : {0, static_cast<int>(kSide)}) {
        double phase = side == 0 ? cycle + 0.5 : cycle;
        phase -= std::floor(phase);
        const Vec3 ankle = ankle_at(body, shoe, phase) + Vec3{posture.pelvis_position.x, 0.0, 0.0};
        reach(posture, side, world[static_cast<std::size_t>(left_thigh + side)].position, ankle, foot_pitch(phase));
    }
    return posture;
}

Posture between(const Posture& a, const Posture& b, double t) {
    Posture posture;
    posture.pelvis_position = a.pelvis_position + (b.pelvis_position - a.pelvis_position) * t;
    for (std::size_t j = 0; j < kFigureJoints; ++j) posture.rotations[j] = slerp(a.rotations[j], b.rotations[j], t);
    return posture;
}

}  // namespace

std::vector<Vec3> posed_vertices(const Mesh& body, const Posture& posture, const std::vector<uint32_t>& vertices) {
    const auto& skeleton = figure_skeleton();
    const auto world = world_of(posture);
    std::vector<Vec3> posed;
    posed.reserve(vertices.size());
    for (const uint32_t v : vertices) {
        Vec3 sum;
        for (std::size_t i = 0; i < 2; ++i) {
            const std::size_t j = body.joints[v][i];
            const double weight = static_cast<double>(body.weights[v][i]);
            sum = sum + (world[j].position + rotate(world[j].rotation, body.positions[v] - skeleton[j].position)) * weight;
        }
        posed.push_back(sum);
    }
    return posed;
}

Walk figure_walk(const Mesh& body) {
    // Only the shoes can be lowest.
    std::vector<uint32_t> shoes, right_shoe;
    for (uint32_t v = 0; v < body.positions.size(); ++v) {
        if (body.positions[v].y > 0.06) continue;
        shoes.push_back(v);
        if (body.positions[v].z > 0.0) right_shoe.push_back(v);
    }
    Walk walk;
    for (uint32_t i = 0; i <= kPostures; ++i) {
        walk.seconds.push_back(static_cast<double>(i) / kPostures);
        walk.postures.push_back(posture_at(body, right_shoe, walk.seconds.back()));
    }
    for (uint32_t i = 0; i <= kPelvisKeys; ++i) {
        const uint32_t first = std::min(i * kPostures / kPelvisKeys, kPostures - 1);
        const double t = static_cast<double>(i) * kPostures / kPelvisKeys - first;
        const Posture posture = between(walk.postures[first], walk.postures[first + 1], t);
        double lowest = posture.pelvis_position.y;
        for (const Vec3& p : posed_vertices(body, posture, shoes)) lowest = std::min(lowest, p.y);
        walk.pelvis_seconds.push_back(static_cast<double>(i) / kPelvisKeys);
        walk.pelvis_positions.push_back(posture.pelvis_position - Vec3{0.0, lowest, 0.0});
    }
    return walk;
}

}  // namespace gnomon::makers
