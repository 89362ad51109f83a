// SPDX-License-Identifier: Apache-2.0
// The figure's walk: the feet are led, the legs follow by inverse kinematics, the pelvis is raised so that the lower foot
// touches the ground.
#include <algorithm>

#include "figure_motion.hpp"

namespace gnomon::makers {
namespace {

constexpr uint32_t kPostures = 30;    // Per second.
constexpr uint32_t kPelvisKeys = 16;  // Per posture; the lower foot changes at an instant, which these keys must follow.
constexpr double kSpeed = 1.25;       // Metres per second, and per cycle.
constexpr double kStart = -0.35;      // Where the walk begins, metres.
constexpr double kStance = 0.6;       // Share of the cycle in which a foot is on the ground.
constexpr double kFootAhead = 0.30;   // Of the ankle before the hip when the heel strikes, metres.
constexpr double kFirstPhase = 0.92;  // Of the right foot at 0 s: in its swing, so that the first shutter shows it move.

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0};

/// The foot's pitch in radians, toes up positive: heel strike, flat, heel off, toe off, swing, heel strike.
double foot_pitch(double phase) {
    static constexpr Key kKeys[] = {{0.0, 0.33}, {0.1, 0.0}, {0.36, 0.0}, {0.62, -0.95}, {0.88, 0.28}, {1.0, 0.33}};
    return eased(kKeys, phase);
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

void swing_arm(Posture& posture, int side, double forward) {
    pose_arm(posture, side, 0.08 + 0.52 * forward, 0.55 + 0.3 * forward, 0.1 + 0.1 * forward);
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

}  // namespace

Motion figure_walk(const Mesh& body) {
    std::vector<uint32_t> right_shoe;
    for (const uint32_t v : shoe_vertices(body)) {
        if (body.positions[v].z > 0.0) right_shoe.push_back(v);
    }
    Motion walk;
    for (uint32_t i = 0; i <= kPostures; ++i) {
        walk.seconds.push_back(static_cast<double>(i) / kPostures);
        walk.postures.push_back(posture_at(body, right_shoe, walk.seconds.back()));
    }
    put_on_ground(walk, body, kPelvisKeys, [](double) { return 0.0; });
    return walk;
}

}  // namespace gnomon::makers
