// SPDX-License-Identifier: Apache-2.0
// The scene character: a kick toward the light, after Hong and Oh 2018 (Fig. 10) and 2017 (Fig. 5 and 6).
#include "common.hpp"
#include "figure_motion.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

/// The right leg swings forward, fastest in the first shutter, and comes down again within a second.
Posture kick_at(double seconds) {
    static constexpr Key kThigh[] = {{-0.11, -0.6}, {0.055, 1.5}, {0.55, 0.3}, {1.0, 0.1}};
    static constexpr Key kKnee[] = {{-0.08, 1.8}, {0.05, 0.1}, {0.4, 0.7}, {1.0, 0.2}};
    static constexpr Key kLean[] = {{-0.1, -0.12}, {0.12, 0.2}, {0.6, 0.05}, {1.0, 0.0}};
    static constexpr Key kTurn[] = {{-0.1, -0.3}, {0.12, 0.25}, {0.6, 0.05}, {1.0, 0.0}};
    const double lean = eased(kLean, seconds), turn = eased(kTurn, seconds);
    const Vec3 up{0, 1, 0};
    Posture posture;
    posture.rotations[pelvis] = axis_angle(up, turn) * about_z(0.5 * lean);
    posture.rotations[spine] = axis_angle(up, -0.6 * turn) * about_z(0.4 * lean - 0.1);
    posture.rotations[chest] = axis_angle(up, -1.2 * turn) * about_z(0.3 * lean - 0.1);
    posture.rotations[neck] = about_z(-0.3 * lean - 0.05);
    posture.rotations[head] = axis_angle(up, 0.6 * turn) * about_z(-0.4 * lean);
    // The arms go against the legs, away from the body.
    pose_arm(posture, 0, 0.1 + 2.4 * turn, 0.7, 0.1, 0.55);
    pose_arm(posture, kSide, 0.1 - 2.4 * turn, 0.7, 0.1, 0.55);

    const JointInfo &hips = figure_skeleton()[pelvis], &ankle = figure_skeleton()[left_foot];
    posture.pelvis_position = hips.position + Vec3{0.02, -0.02, 0.0};
    reach(posture, 0, world_of(posture)[left_thigh].position, ankle.position, 0.0);
    posture.rotations[right_thigh] = conjugate(posture.rotations[pelvis]) * about_z(eased(kThigh, seconds));
    posture.rotations[right_shin] = about_z(-eased(kKnee, seconds));
    posture.rotations[right_foot] = about_z(-0.5);
    return posture;
}

Motion kick(const Mesh& body) {
    Motion motion;
    motion.seconds = key_times(1.0, 96);
    for (const double seconds : motion.seconds) motion.postures.push_back(kick_at(seconds));
    put_on_ground(motion, body, 4, [](double) { return 0.0; });
    return motion;
}

}  // namespace

void make_character(const std::filesystem::path& path, const CharacterOptions& options) {
    require_range("triangles", options.triangles, 2000, 2e6);
    GltfWriter writer("character");
    add_studio(writer, 0.7, 0.6);
    const Mesh body = figure_body(options.triangles);
    add_figure(writer, "character", body, kick(body));
    writer.add_camera("camera", {2.9, 1.5, 3.3}, {0.05, 0.84, 0.0}, 0.45, 4.0 / 3.0, 0.1, 100.0);
    writer.add_spot_light("light", looking_at({5.2, 4.0, 1.5}, {-0.2, 0.8, 0.0}), {1.0, 0.96, 0.9}, 210.0, 0.4, 0.56);
    if (options.fill_light) add_fill_light(writer, {0.2, -0.7, -0.8});
    writer.write(path);
}

}  // namespace gnomon::makers
