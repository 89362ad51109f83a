// SPDX-License-Identifier: Apache-2.0
// What the figure's motions are made of, and the animated node.
#include "figure_motion.hpp"

#include <algorithm>

#include "gltf_writer.hpp"

namespace gnomon::makers {
namespace {

Posture between(const Posture& a, const Posture& b, double t) {
    Posture posture;
    posture.pelvis_position = a.pelvis_position + (b.pelvis_position - a.pelvis_position) * t;
    for (std::size_t j = 0; j < kFigureJoints; ++j) posture.rotations[j] = slerp(a.rotations[j], b.rotations[j], t);
    return posture;
}

}  // namespace

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

double toe_pitch(double pitch) { return std::min(0.5, 0.6 * std::max(0.0, -pitch)); }

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

void pose_arm(Posture& posture, int side, double upper_arm, double forearm, double hand, double sideways) {
    const auto upper = static_cast<std::size_t>(left_upper_arm + side);
    const double outward = side == 0 ? 1.0 : -1.0;  // About +X, the sense that takes the arm from the body.
    const auto about_x = [&](double angle) { return axis_angle({1.0, 0.0, 0.0}, outward * angle); };
    posture.rotations[upper] = about_x(sideways) * about_z(upper_arm) * about_x(0.12 - kArmAngle);
    posture.rotations[upper + 1] = about_z(forearm);
    posture.rotations[upper + 2] = about_z(hand);
}

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

std::vector<uint32_t> shoe_vertices(const Mesh& body) {
    std::vector<uint32_t> shoes;
    for (uint32_t v = 0; v < body.positions.size(); ++v) {
        if (body.positions[v].y <= 0.06) shoes.push_back(v);
    }
    return shoes;
}

void put_on_ground(Motion& motion, const Mesh& body, uint32_t keys, const std::function<double(double)>& clearance) {
    const std::vector<uint32_t> shoes = shoe_vertices(body);
    const auto intervals = static_cast<uint32_t>(motion.postures.size() - 1);
    const uint32_t count = keys * intervals;
    for (uint32_t i = 0; i <= count; ++i) {
        const uint32_t first = std::min(i / keys, intervals - 1);
        const double t = static_cast<double>(i) / keys - first;
        const Posture posture = between(motion.postures[first], motion.postures[first + 1], t);
        double lowest = posture.pelvis_position.y;
        for (const Vec3& p : posed_vertices(body, posture, shoes)) lowest = std::min(lowest, p.y);
        const double seconds = motion.seconds.back() * i / count;
        motion.pelvis_seconds.push_back(seconds);
        motion.pelvis_positions.push_back(posture.pelvis_position - Vec3{0.0, lowest - clearance(seconds), 0.0});
    }
}

void add_figure(GltfWriter& writer, const std::string& name, const Mesh& body, const Motion& motion) {
    const auto& skeleton = figure_skeleton();
    const int times = writer.add_times(motion.seconds);
    std::vector<int> nodes;
    std::vector<Vec3> bind_positions;
    for (std::size_t j = 0; j < kFigureJoints; ++j) {
        const JointInfo& info = skeleton[j];
        const bool root = info.parent < 0;
        const Vec3 offset =
            root ? motion.pelvis_positions[0] : info.position - skeleton[static_cast<std::size_t>(info.parent)].position;
        std::vector<Quat> rotations;
        for (const Posture& posture : motion.postures) rotations.push_back(posture.rotations[j]);
        const int parent = root ? -1 : nodes[static_cast<std::size_t>(info.parent)];
        nodes.push_back(writer.add_node(info.name, {offset, rotations[0]}, parent));
        writer.animate_rotation(nodes.back(), times, rotations);
        bind_positions.push_back(info.position);
    }
    writer.animate_translation(nodes[pelvis], writer.add_times(motion.pelvis_seconds), motion.pelvis_positions);
    const Primitive primitive{&body, writer.add_material(name, {})};
    writer.add_skinned_node(name, writer.add_mesh(name, {&primitive, 1}), nodes, bind_positions);
}

}  // namespace gnomon::makers
