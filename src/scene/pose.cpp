// SPDX-License-Identifier: Apache-2.0
// Posing a scene: node transforms to palette matrices, morph weights, and rigid motions of cameras and lights.
#include <math/pose.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gnomon/error.hpp>

#include "scene/rig.hpp"

namespace gnomon {

namespace {

// Everything animated, at one time.
struct State {
    std::vector<Rig::Transform> transforms;  // Of each node.
    std::vector<double> weights;             // As Pose::morph_weights.
};

State rest_state(const Rig& rig) {
    State state;
    state.transforms.reserve(rig.nodes.size());
    for (const Rig::Node& node : rig.nodes) state.transforms.push_back(node.transform);
    for (const Rig::WeightBlock& block : rig.weights) {
        state.weights.insert(state.weights.end(), block.rest.begin(), block.rest.end());
    }
    return state;
}

void animate(const Rig& rig, const Rig::Animation& animation, double t, State& state) {
    std::vector<double> values;
    for (const Rig::Channel& channel : animation.channels) {
        const Rig::Sampler& sampler = animation.samplers[channel.sampler];
        values.resize(sampler.width);
        sample_track(rig, sampler, channel.path, t, values.data());
        const auto node = static_cast<size_t>(channel.node);
        Rig::Transform& transform = state.transforms[node];
        switch (channel.path) {
            case Rig::Path::translation:
                transform.translation = {values[0], values[1], values[2]};
                break;
            case Rig::Path::scale:
                transform.scale = {values[0], values[1], values[2]};
                break;
            case Rig::Path::rotation:
                transform.rotation = glm::dquat(values[3], values[0], values[1], values[2]);
                break;
            case Rig::Path::weights:
                // A mesh that the scene does not show has no weights in the pose.
                if (rig.weights_of_node[node] >= 0) {
                    const Rig::WeightBlock& block = rig.weights[static_cast<size_t>(rig.weights_of_node[node])];
                    std::copy(values.begin(), values.end(), state.weights.begin() + block.first);
                }
                break;
        }
    }
}

glm::dmat4 local_matrix(const Rig::Node& node, const Rig::Transform& transform) {
    if (node.has_matrix) return node.matrix;
    return glm::scale(glm::translate(glm::dmat4(1.0), transform.translation) * glm::mat4_cast(transform.rotation),
                      transform.scale);
}

std::vector<glm::dmat4> world_matrices(const Rig& rig, const State& state) {
    std::vector<glm::dmat4> world(rig.nodes.size());
    for (const uint32_t n : rig.order) {
        const Rig::Node& node = rig.nodes[n];
        const glm::dmat4 local = local_matrix(node, state.transforms[n]);
        world[n] = node.parent == Rig::kNoNode ? local : world[static_cast<size_t>(node.parent)] * local;
    }
    return world;
}

// The rotations of each node and its ancestors alone.
std::vector<glm::dquat> world_rotations(const Rig& rig, const State& state) {
    std::vector<glm::dquat> world(rig.nodes.size());
    for (const uint32_t n : rig.order) {
        const int32_t parent = rig.nodes[n].parent;
        const glm::dquat& local = state.transforms[n].rotation;
        world[n] = glm::normalize(parent == Rig::kNoNode ? local : world[static_cast<size_t>(parent)] * local);
    }
    return world;
}

// Strips the scale. The view axis -Z and, as far as it is perpendicular, the up axis Y keep their directions; X follows, so
// that a mirrored node gives a rotation, too. Where a scale of 0 leaves no axes, they are those of the rotations alone.
Rigid rigid_of(const glm::dmat4& world, const glm::dquat& rotation_without_scale) {
    Rigid rigid;
    rigid.translation = glm::dvec3(world[3]);
    const glm::dvec3 back(world[2]);
    const double length = glm::length(back);
    const glm::dvec3 z = back / length;
    const glm::dvec3 up = glm::dvec3(world[1]) - glm::dot(glm::dvec3(world[1]), z) * z;
    constexpr double kLeast = 1e-150;  // Squares of shorter ones underflow.
    if (length > kLeast && glm::length(up) > 1e-12 * glm::length(glm::dvec3(world[1])) && glm::length(up) > kLeast) {
        const glm::dvec3 y = glm::normalize(up);
        rigid.rotation = glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(y, z), y, z)));
    } else {
        rigid.rotation = rotation_without_scale;
    }
    return rigid;
}

bool is_finite(glm::vec4 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w); }

// Builds poses of one scene; knows how to name what went wrong.
class Poser {
public:
    Poser(const Scene& scene, const AnimationChoice& choice) : scene_(scene), rig_(*scene.rig) {
        if (choice.kind == AnimationChoice::Kind::all) {
            for (const Rig::Animation& animation : rig_.animations) chosen_.push_back(&animation);
        }
        if (choice.kind == AnimationChoice::Kind::one && !rig_.animations.empty()) {
            if (choice.index >= rig_.animations.size()) {
                throw Error(ErrorKind::usage, "there is no animation " + std::to_string(choice.index),
                            "in " + scene.path.string(), "choose an index below " + std::to_string(rig_.animations.size()));
            }
            chosen_.push_back(&rig_.animations[choice.index]);
        }
    }

    Pose at(double seconds) const {
        State state = rest_state(rig_);
        for (const Rig::Animation* animation : chosen_) animate(rig_, *animation, seconds, state);
        const std::vector<glm::dmat4> world = world_matrices(rig_, state);
        Pose pose;
        pose.seconds = seconds;
        add_palette(world, seconds, pose);
        add_weights(state, seconds, pose);
        const std::vector<glm::dquat> rotations = world_rotations(rig_, state);
        pose.cameras = carried(rig_.cameras, rotations, world, seconds);
        pose.lights = carried(rig_.lights, rotations, world, seconds);
        return pose;
    }

private:
    [[noreturn]] void fail(const std::string& what, int32_t node, double seconds) const {
        std::string where = "at " + std::to_string(seconds) + " s in " + scene_.path.string();
        for (const Rig::Animation* animation : chosen_) where += ", " + animation->name;
        const std::string name = node == Rig::kNoNode ? "" : " of " + rig_.nodes[static_cast<size_t>(node)].name;
        throw Error(ErrorKind::input, what + name + " is not finite", where, "repair the animation or choose another");
    }

    void add_palette(const std::vector<glm::dmat4>& world, double seconds, Pose& pose) const {
        pose.palette.reserve(3 * rig_.palette.size());
        for (const Rig::PaletteEntry& entry : rig_.palette) {
            glm::dmat4 matrix = entry.offset;
            if (entry.node != Rig::kNoNode) matrix = world[static_cast<size_t>(entry.node)] * entry.offset;
            for (int row = 0; row < 3; ++row) {
                const glm::vec4 rounded(glm::dvec4(matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]));
                if (!is_finite(rounded)) fail("the matrix", entry.node, seconds);
                pose.palette.push_back(rounded);
            }
        }
    }

    void add_weights(const State& state, double seconds, Pose& pose) const {
        pose.morph_weights.assign(state.weights.begin(), state.weights.end());
        for (const Rig::WeightBlock& block : rig_.weights) {
            for (size_t i = 0; i < block.rest.size(); ++i) {
                if (!std::isfinite(pose.morph_weights[block.first + i])) {
                    fail("morph weight " + std::to_string(i), block.node, seconds);
                }
            }
        }
    }

    std::vector<Rigid> carried(const std::vector<Rig::Carrier>& carriers, const std::vector<glm::dquat>& rotations,
                               const std::vector<glm::dmat4>& world, double seconds) const {
        std::vector<Rigid> result;
        for (const Rig::Carrier& carrier : carriers) {
            Rigid rigid = carrier.fixed;
            if (carrier.node != Rig::kNoNode) {
                const auto node = static_cast<size_t>(carrier.node);
                rigid = rigid_of(world[node], rotations[node]);
            }
            const glm::dvec3 p = rigid.translation;
            const glm::dquat q = rigid.rotation;
            if (!std::isfinite(p.x + p.y + p.z + q.w + q.x + q.y + q.z)) fail("the place", carrier.node, seconds);
            result.push_back(rigid);
        }
        return result;
    }

    const Scene& scene_;
    const Rig& rig_;
    std::vector<const Rig::Animation*> chosen_;
};

}  // namespace

std::vector<Pose> pose_scene(const Scene& scene, const AnimationChoice& animation, double open_s, double close_s,
                             uint32_t segments) {
    const Poser poser(scene, animation);
    std::vector<Pose> poses;
    poses.reserve(size_t{segments} + 1);
    for (uint32_t k = 0; k <= segments; ++k) {
        const double s = segments == 0 ? 0.0 : static_cast<double>(k) / segments;
        poses.push_back(poser.at((1.0 - s) * open_s + s * close_s));
    }
    return poses;
}

std::vector<glm::vec3> posed_positions(const Scene& scene, const Pose& pose) {
    std::vector<glm::vec3> positions;
    positions.reserve(scene.vertices.size());
    for (const Vertex& vertex : scene.vertices) {
        const Morph& morph = scene.morphs[vertex.morph];
        glm::vec3 p = vertex.position;
        for (uint32_t j = 0; j < morph.target_count; ++j) {
            const size_t delta = size_t{morph.delta_first} + size_t{j} * morph.vertex_count + vertex.morph_vertex;
            p = shared::morph_add(p, scene.morph_positions[delta], pose.morph_weights[morph.weight_first + j]);
        }
        glm::vec3 sum(0.0f);
        for (uint32_t i = 0; i < vertex.influence_count; ++i) {
            const Influence& influence = scene.influences[vertex.influence_first + i];
            const glm::vec4* rows = pose.palette.data() + size_t{3} * influence.matrix;
            sum = shared::skin_add(sum, rows[0], rows[1], rows[2], p, influence.weight);
        }
        positions.push_back(sum);
    }
    return positions;
}

}  // namespace gnomon
