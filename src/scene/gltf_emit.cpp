// SPDX-License-Identifier: Apache-2.0
// Instancing: each primitive is read once and appended to the scene for every shown node with its mesh.
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_build.hpp"
#include "scene/gltf_mesh.hpp"

namespace gnomon::gltf {

namespace {

// Bounds on memory, checked before anything is decoded: a small file can name the same data any number of times.
constexpr uint64_t kMaxSceneBytes = uint64_t{1} << 30;
constexpr uint64_t kMaxPrimitiveBytes = uint64_t{1} << 29;
constexpr uint64_t kMaxWeights = uint64_t{1} << 24;

class Builder {
public:
    Builder(const Document& document, const std::vector<bool>& shown, const Materials& materials, Scene& scene, Rig& rig)
        : document_(document), model_(document.model), materials_(materials), scene_(scene), rig_(rig) {
        nodes_of_mesh_.resize(model_.meshes.size());
        rig.weights_of_node.assign(model_.nodes.size(), -1);
        for (size_t n = 0; n < model_.nodes.size(); ++n) {
            if (!shown[n] || model_.nodes[n].mesh < 0) continue;
            nodes_of_mesh_[static_cast<size_t>(model_.nodes[n].mesh)].push_back(n);
            add_weights(n);
        }
        scene.morphs.push_back({});
    }

    void build() {
        check_size();
        for (size_t mesh = 0; mesh < model_.meshes.size(); ++mesh) {
            for (size_t primitive = 0; primitive < model_.meshes[mesh].primitives.size(); ++primitive) {
                const std::optional<PrimitiveData> data = read_primitive(document_, mesh, primitive, materials_, report_);
                if (!data || nodes_of_mesh_[mesh].empty()) continue;
                const uint32_t delta_first = add_deltas(*data);
                for (const size_t node : nodes_of_mesh_[mesh]) add_instance(*data, node, delta_first);
            }
        }
        report_.write(scene_.warnings);
        if (skewed_matrices_ != 0) {
            scene_.warnings.push_back(std::to_string(skewed_matrices_) +
                                      " inverse bind matrices have a last row other than 0 0 0 1: it is ignored");
        }
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
        throw Error(ErrorKind::input, what, "in " + document_.name, hint);
    }

    // Sums the bounds of all instances, and reserves accordingly.
    void check_size() {
        PrimitiveBound total;
        for (size_t mesh = 0; mesh < model_.meshes.size(); ++mesh) {
            const uint64_t instances = nodes_of_mesh_[mesh].size();
            for (const tinygltf::Primitive& primitive : model_.meshes[mesh].primitives) {
                const PrimitiveBound bound = bound_of(document_, primitive);
                if (bound.decoded_bytes > kMaxPrimitiveBytes) fail("a primitive has more than 512 MiB of data", "split it");
                total.vertices += instances * bound.vertices;
                total.triangles += instances * bound.triangles;
                total.influences += instances * std::max(bound.influences, bound.vertices);
                total.deltas += bound.deltas;
                const uint64_t scene_bytes = total.vertices * sizeof(Vertex) + total.triangles * sizeof(Triangle) +
                                             total.influences * sizeof(Influence) + total.deltas * 2 * sizeof(glm::vec3);
                if (scene_bytes > kMaxSceneBytes) {
                    fail("the scene has more geometry than fits 1 GiB", "render it in parts, or with fewer instances");
                }
            }
        }
        scene_.vertices.reserve(total.vertices);
        scene_.triangles.reserve(total.triangles);
        scene_.influences.reserve(total.influences);
        scene_.morph_positions.reserve(total.deltas);
        scene_.morph_normals.reserve(total.deltas);
    }

    void add_weights(size_t node) {
        const tinygltf::Mesh& mesh = model_.meshes[static_cast<size_t>(model_.nodes[node].mesh)];
        const size_t targets = mesh.primitives[0].targets.size();
        if (targets == 0) return;
        if (weight_count_ + targets > kMaxWeights) fail("the scene has too many morph weights", "use fewer morph targets");
        Rig::WeightBlock block;
        block.node = static_cast<int32_t>(node);
        block.first = static_cast<uint32_t>(weight_count_);
        weight_count_ += targets;
        block.rest = !model_.nodes[node].weights.empty() ? model_.nodes[node].weights : mesh.weights;
        block.rest.resize(targets, 0.0);
        rig_.weights_of_node[node] = static_cast<int32_t>(rig_.weights.size());
        rig_.weights.push_back(std::move(block));
    }

    uint32_t add_deltas(const PrimitiveData& data) {
        const auto first = static_cast<uint32_t>(scene_.morph_positions.size());
        scene_.morph_positions.insert(scene_.morph_positions.end(), data.delta_positions.begin(), data.delta_positions.end());
        scene_.morph_normals.insert(scene_.morph_normals.end(), data.delta_normals.begin(), data.delta_normals.end());
        return first;
    }

    void add_instance(const PrimitiveData& data, size_t node, uint32_t delta_first) {
        const auto vertex_first = static_cast<uint32_t>(scene_.vertices.size());
        const auto vertex_count = static_cast<uint32_t>(data.vertices.size());
        uint32_t morph = 0;
        if (data.target_count != 0) {
            const Rig::WeightBlock& block = rig_.weights[static_cast<size_t>(rig_.weights_of_node[node])];
            morph = static_cast<uint32_t>(scene_.morphs.size());
            scene_.morphs.push_back({data.target_count, vertex_count, delta_first, block.first});
        }
        const int skin = model_.nodes[node].skin;
        const bool skinned = skin >= 0 && !data.influence_first.empty();
        if (skin >= 0 && !skinned) ++report_.primitives_without_joints;
        const uint32_t matrix_first = skinned ? matrices_of_skin(static_cast<size_t>(skin)) : matrix_of_node(node);
        const size_t joint_count = skinned ? model_.skins[static_cast<size_t>(skin)].joints.size() : 1;
        for (uint32_t v = 0; v < vertex_count; ++v) {
            Vertex vertex = data.vertices[v];
            vertex.morph = morph;
            vertex.morph_vertex = v;
            vertex.influence_first = static_cast<uint32_t>(scene_.influences.size());
            vertex.influence_count = skinned ? data.influence_first[v + 1] - data.influence_first[v] : 1;
            for (uint32_t i = 0; i < vertex.influence_count; ++i) {
                const Influence influence = skinned ? data.influences[data.influence_first[v] + i] : Influence{};
                if (influence.matrix >= joint_count) {
                    fail("joint " + std::to_string(influence.matrix) + " of a vertex of " + node_label(model_, node) +
                             " is out of range: its skin has " + std::to_string(joint_count) + " joints",
                         "repair or export the file again");
                }
                scene_.influences.push_back({matrix_first + influence.matrix, influence.weight});
            }
            scene_.vertices.push_back(vertex);
        }
        for (const auto& t : data.triangles) {
            scene_.triangles.push_back(
                {{vertex_first + t[0], vertex_first + t[1], vertex_first + t[2]}, static_cast<uint32_t>(data.material)});
        }
    }

    uint32_t matrix_of_node(size_t node) {
        const auto [it, is_new] = matrix_of_node_.try_emplace(node, static_cast<uint32_t>(rig_.palette.size()));
        if (is_new) rig_.palette.push_back({static_cast<int32_t>(node), glm::dmat4(1.0)});
        return it->second;
    }

    // World matrices of the joints times their inverse bind matrices; the node of the mesh plays no part (glTF 2.0, 3.7.3.3).
    uint32_t matrices_of_skin(size_t number) {
        const auto [it, is_new] = matrices_of_skin_.try_emplace(number, static_cast<uint32_t>(rig_.palette.size()));
        if (!is_new) return it->second;
        const tinygltf::Skin& skin = model_.skins[number];
        std::vector<float> inverse;
        if (skin.inverseBindMatrices >= 0) inverse = read_floats(document_, skin.inverseBindMatrices);
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            glm::dmat4 offset(1.0);
            if (!inverse.empty()) offset = glm::dmat4(glm::make_mat4(inverse.data() + 16 * j));
            if (offset[0][3] != 0.0 || offset[1][3] != 0.0 || offset[2][3] != 0.0 || offset[3][3] != 1.0) {
                ++skewed_matrices_;
                for (int column = 0; column < 4; ++column) offset[column][3] = column == 3 ? 1.0 : 0.0;
            }
            rig_.palette.push_back({skin.joints[j], offset});
        }
        return it->second;
    }

    const Document& document_;
    const tinygltf::Model& model_;
    const Materials& materials_;
    Scene& scene_;
    Rig& rig_;
    MeshReport report_;
    std::vector<std::vector<size_t>> nodes_of_mesh_;
    std::map<size_t, uint32_t> matrix_of_node_;
    std::map<size_t, uint32_t> matrices_of_skin_;
    uint64_t weight_count_ = 0;
    uint64_t skewed_matrices_ = 0;
};

}  // namespace

void build_meshes(const Document& document, const std::vector<bool>& shown, const Materials& materials, Scene& scene,
                  Rig& rig) {
    Builder(document, shown, materials, scene, rig).build();
}

}  // namespace gnomon::gltf
