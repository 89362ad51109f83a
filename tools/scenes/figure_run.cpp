// SPDX-License-Identifier: Apache-2.0
// The figure's run: angles of the legs over the cycle, about those of a sprint; the pelvis follows the foot on the ground, and
// a parabola between the steps.
#include "figure_motion.hpp"

namespace gnomon::makers {
namespace {

constexpr uint32_t kPostures = 30;    // Per cycle.
constexpr uint32_t kPelvisKeys = 16;  // Per posture.
constexpr double kPeriod = 0.5;       // Seconds.
constexpr double kSpeed = 6.2;        // Metres per second.
constexpr double kStance = 0.3;       // Share of the cycle in which a foot is on the ground.
constexpr double kRise = 0.05;        // Of the lower foot between two steps, metres.
constexpr double kFirstPhase = 0.36;  // Of the right foot at 0 s: it has pushed off, and no foot is on the ground.

constexpr Vec3 kY{0, 1, 0};

/// A smooth periodic value (Catmull-Rom) through ten values at equal phases.
double cyclic(const std::array<double, 10>& values, double phase) {
    const double at = (phase - std::floor(phase)) * 10.0;
    const auto i = static_cast<std::size_t>(at);
    const double t = at - static_cast<double>(i);
    const double p0 = values[(i + 9) % 10], p1 = values[i % 10], p2 = values[(i + 1) % 10], p3 = values[(i + 2) % 10];
    return p1 + 0.5 * t * (p2 - p0 + t * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + t * (3.0 * (p1 - p2) + p3 - p0)));
}

/// Phase 0 is the strike of this leg's foot; it leaves the ground at kStance.
void pose_leg(Posture& posture, int side, double phase) {
    static constexpr std::array<double, 10> kThigh = {0.45, 0.22, -0.14, -0.42, -0.34, 0.12, 0.66, 1.04, 1.1, 0.8};
    static constexpr std::array<double, 10> kKnee = {0.35, 0.6, 0.5, 0.36, 1.0, 1.8, 2.1, 1.75, 1.1, 0.5};
    static constexpr std::array<double, 10> kAnkle = {0.05, 0.38, 0.3, -0.35, -0.5, -0.25, 0.0, 0.05, 0.1, 0.1};
    static constexpr std::array<double, 10> kToes = {0.0, 0.0, 0.2, 0.5, 0.15, 0.0, 0.0, 0.0, 0.0, 0.0};
    const auto thigh = static_cast<std::size_t>(left_thigh + side);
    posture.rotations[thigh] = conjugate(posture.rotations[pelvis]) * about_z(cyclic(kThigh, phase));
    posture.rotations[thigh + 1] = about_z(-cyclic(kKnee, phase));
    posture.rotations[thigh + 2] = about_z(cyclic(kAnkle, phase));
    posture.rotations[thigh + 3] = about_z(cyclic(kToes, phase));
}

Posture posture_at(double seconds) {
    const double cycle = seconds / kPeriod + kFirstPhase;
    const double right_ahead = std::cos(2.0 * kPi * (cycle - 0.78));
    Posture posture;
    posture.rotations[pelvis] = axis_angle(kY, 0.16 * right_ahead) * about_z(-0.1);
    posture.rotations[spine] = axis_angle(kY, -0.16 * right_ahead) * about_z(-0.08);
    posture.rotations[chest] = axis_angle(kY, -0.2 * right_ahead) * about_z(-0.06);
    posture.rotations[neck] = axis_angle(kY, 0.1 * right_ahead) * about_z(0.08);
    posture.rotations[head] = axis_angle(kY, 0.1 * right_ahead) * about_z(0.1);
    pose_arm(posture, 0, -0.12 + 0.85 * right_ahead, 1.5 + 0.35 * right_ahead, 0.1);
    pose_arm(posture, kSide, -0.12 - 0.85 * right_ahead, 1.5 - 0.35 * right_ahead, 0.1);
    pose_leg(posture, 0, cycle + 0.5);
    pose_leg(posture, kSide, cycle);
    posture.pelvis_position = {kSpeed * seconds, 0.9, 0.0};
    return posture;
}

double clearance(double seconds) {
    const double steps = 2.0 * (seconds / kPeriod + kFirstPhase);
    const double flight = (steps - std::floor(steps) - 2.0 * kStance) / (1.0 - 2.0 * kStance);
    return flight > 0.0 ? 4.0 * kRise * flight * (1.0 - flight) : 0.0;
}

}  // namespace

Motion figure_run(const Mesh& body) {
    Motion run;
    for (uint32_t i = 0; i <= kPostures; ++i) {
        run.seconds.push_back(kPeriod * i / kPostures);
        run.postures.push_back(posture_at(run.seconds.back()));
    }
    put_on_ground(run, body, kPelvisKeys, clearance);
    return run;
}

}  // namespace gnomon::makers
