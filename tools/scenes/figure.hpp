// SPDX-License-Identifier: Apache-2.0
// The figure: skeleton, body and motions. It faces +X, its right side is at +Z, and it stands on y = 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh.hpp"

namespace gnomon::makers {

class GltfWriter;

/// Parents come before their children. Right follows left by kSide.
enum Joint : uint16_t {
    pelvis,
    spine,
    chest,
    neck,
    head,
    left_clavicle,
    left_upper_arm,
    left_forearm,
    left_hand,
    left_thigh,
    left_shin,
    left_foot,
    left_toes,
    right_clavicle,
    right_upper_arm,
    right_forearm,
    right_hand,
    right_thigh,
    right_shin,
    right_foot,
    right_toes,
    kFigureJoints
};
inline constexpr uint16_t kSide = right_clavicle - left_clavicle;

struct JointInfo {
    const char* name;
    int parent;     ///< A Joint, or -1.
    Vec3 position;  ///< In the bind pose, in which no joint is rotated.
};
const std::array<JointInfo, kFigureJoints>& figure_skeleton();

/// The angle from the vertical at which the arms hang in the bind pose.
inline constexpr double kArmAngle = 0.26;

/// Closed tubes with vertex colours, bound to the skeleton, about `triangles` in all.
Mesh figure_body(uint32_t triangles);

/// One posture: where the pelvis is, and how every joint is rotated relative to its parent.
struct Posture {
    Vec3 pelvis_position;
    std::array<Quat, kFigureJoints> rotations;
};

/// A motion along +X from 0 s. Joints turn evenly between the postures.
struct Motion {
    std::vector<double> seconds;  ///< Of `postures`.
    std::vector<Posture> postures;
    std::vector<double> pelvis_seconds;  ///< More of them, so that the feet stay on the ground between the postures too.
    std::vector<Vec3> pelvis_positions;
};

/// One cycle in one second, always on the ground.
Motion figure_walk(const Mesh& body);

/// One cycle of a run in half a second, with both feet off the ground between the steps.
Motion figure_run(const Mesh& body);

/// Writes the skeleton, its motion and a mesh that is bound to it, with a material of the same name.
void add_figure(GltfWriter& writer, const std::string& name, const Mesh& body, const Motion& motion);

}  // namespace gnomon::makers
