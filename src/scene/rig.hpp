// SPDX-License-Identifier: Apache-2.0
// What moves a scene: the node graph, animation samplers, and how the matrices of a pose follow from the nodes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gnomon/scene.hpp>
#include <string>
#include <vector>

namespace gnomon {

struct Rig {
    static constexpr int32_t kNoNode = -1;

    /// Where a node stands in its parent: translation * rotation * scale, or a matrix.
    struct Transform {
        glm::dvec3 translation{0.0};
        glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
        glm::dvec3 scale{1.0};
    };

    struct Node {
        std::string name;  ///< With its index, for messages.
        int32_t parent = kNoNode;
        bool has_matrix = false;
        Transform transform;
        glm::dmat4 matrix{1.0};
    };

    /// A palette matrix: world matrix of `node` (identity for kNoNode) times `offset`.
    struct PaletteEntry {
        int32_t node = kNoNode;
        glm::dmat4 offset{1.0};
    };

    /// The morph weights of one node with a mesh: `rest` in Pose::morph_weights from `first` on.
    struct WeightBlock {
        int32_t node = kNoNode;
        uint32_t first = 0;
        std::vector<double> rest;
    };

    /// A camera or light: follows a node, or stands where it is put.
    struct Carrier {
        int32_t node = kNoNode;
        Rigid fixed;
    };

    enum class Interpolation { step, linear, cubic_spline };
    enum class Path { translation, rotation, scale, weights };

    /// `width` numbers for each key; with cubic splines, three such groups (in-tangent, value, out-tangent).
    struct Sampler {
        uint32_t times = 0;   ///< Index into Rig::tracks; strictly ascending within rounding, at least one.
        uint32_t values = 0;  ///< Index into Rig::tracks.
        uint32_t width = 0;
        Interpolation interpolation = Interpolation::linear;
    };

    struct Channel {
        uint32_t sampler = 0;
        int32_t node = kNoNode;
        Path path = Path::translation;
    };

    struct Animation {
        std::string name;  ///< With its index, for messages.
        std::vector<Sampler> samplers;
        std::vector<Channel> channels;
    };

    std::vector<Node> nodes;
    std::vector<uint32_t> order;  ///< All nodes, parents before children.
    std::vector<PaletteEntry> palette;
    std::vector<WeightBlock> weights;
    std::vector<int32_t> weights_of_node;  ///< Index into weights for each node, or -1.
    std::vector<Carrier> cameras;
    std::vector<Carrier> lights;
    std::vector<std::vector<float>> tracks;  ///< Numbers of the animations, each accessor once.
    std::vector<Animation> animations;
};

/// The value of a sampler at time t (seconds), before the first and after the last key that key's; `width` numbers into `out`.
/// Rotations are unit quaternions (x, y, z, w) and turn the shorter way.
void sample_track(const Rig& rig, const Rig::Sampler& sampler, Rig::Path path, double t, double* out);

}  // namespace gnomon
