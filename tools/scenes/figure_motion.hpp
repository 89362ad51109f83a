// SPDX-License-Identifier: Apache-2.0
// What the figure's motions are made of: limbs, curves over time, the ground.
#pragma once

#include <functional>

#include "figure.hpp"

namespace gnomon::makers {

inline Quat about_z(double angle) { return axis_angle({0.0, 0.0, 1.0}, angle); }  ///< Positive brings a hanging limb forward.

/// A value that eases from one key to the next; phases rise.
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

struct JointTransform {
    Vec3 position;
    Quat rotation;
};
std::array<JointTransform, kFigureJoints> world_of(const Posture& posture);

/// The angle of the toes when the foot has this pitch and stands on them.
double toe_pitch(double pitch);

/// Bend one leg so that the ankle is at `ankle`, in the plane z = hip's z. side: 0 left, kSide right.
void reach(Posture& posture, int side, Vec3 hip, Vec3 ankle, double pitch);

/// Angles from hanging straight down, forward positive, each relative to the one before; then the arm is raised sideways.
void pose_arm(Posture& posture, int side, double upper_arm, double forearm, double hand, double sideways = 0.0);

/// World positions of some vertices of `body`, by index.
std::vector<Vec3> posed_vertices(const Mesh& body, const Posture& posture, const std::vector<uint32_t>& vertices);

/// The vertices that can be lowest.
std::vector<uint32_t> shoe_vertices(const Mesh& body);

/// Fill the motion's pelvis keys, `keys` per posture: the shoes' lowest vertex is clearance(seconds) over y = 0 at each.
void put_on_ground(Motion& motion, const Mesh& body, uint32_t keys, const std::function<double(double seconds)>& clearance);

}  // namespace gnomon::makers
