// SPDX-License-Identifier: Apache-2.0
// One primitive of a glTF mesh as triangles.
#include "scene/gltf_mesh.hpp"

#include <cmath>

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_check.hpp"

namespace gnomon::gltf {

namespace {

constexpr uint32_t kUnused = 0xffffffffu;

int attribute(const std::map<std::string, int>& attributes, const std::string& name) {
    const auto it = attributes.find(name);
    return it == attributes.end() ? -1 : it->second;
}

bool is_finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// The primitive, the vertices of it that are used, and the reading of its attributes for these.
class Reader {
public:
    Reader(const Document& document, size_t mesh, size_t primitive, MeshReport& report)
        : document_(document),
          from_(document.model.meshes[mesh].primitives[primitive]),
          where_("in " + document.name + ": /meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(primitive)),
          report_(report) {
        const std::string& name = document.model.meshes[mesh].name;
        label_ = "mesh " + std::to_string(mesh) + (name.empty() ? "" : " '" + name + "'");
    }

    PrimitiveData read(const Materials& materials) {
        PrimitiveData to;
        to.material = from_.material < 0 ? materials.materials.size() - 1 : static_cast<size_t>(from_.material);
        read_triangles(to);
        to.vertices.resize(used_.size());
        read_positions(to);
        read_normals(to);
        read_uvs(materials, to);
        read_colors(to);
        read_influences(to);
        read_targets(to);
        return to;
    }

    // The numbers of the vertices, in the order of the primitive's mode; all in range.
    std::vector<uint32_t> read_indices() const {
        std::vector<uint32_t> indices;
        uint32_t restart = kUnused;
        if (from_.indices >= 0) {
            restart >>= 32 - 8 * component_bytes(static_cast<uint32_t>(accessor(from_.indices).componentType));
            indices = read_unsigned(document_, from_.indices);
        } else {
            indices.resize(vertex_count());
            for (size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint32_t>(i);
        }
        for (const uint32_t index : indices) {
            if (index == restart) fail("vertex index " + std::to_string(index) + " is the reserved primitive restart value");
            if (index >= vertex_count()) {
                fail("vertex index " + std::to_string(index) + " is out of range: there are " + std::to_string(vertex_count()) +
                     " vertices");
            }
        }
        return indices;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::input, label_ + ": " + what, where_, "repair or export the file again");
    }

    const tinygltf::Accessor& accessor(int number) const { return document_.model.accessors[static_cast<size_t>(number)]; }

    size_t vertex_count() const { return accessor(attribute(from_.attributes, "POSITION")).count; }

    // Triples of vertices by the primitive's mode; strips keep the facing of their first triangle (glTF 2.0, 3.7.2.1).
    void read_triangles(PrimitiveData& to) {
        const std::vector<uint32_t> indices = read_indices();
        const size_t count = indices.size();
        to.triangles.reserve(from_.mode == TINYGLTF_MODE_TRIANGLES ? count / 3 : count);
        if (from_.mode == TINYGLTF_MODE_TRIANGLES) {
            report_.leftover_indices += count % 3;
            for (size_t i = 0; i + 2 < count; i += 3) to.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
        } else {
            if (count < 3) report_.leftover_indices += count;
            const bool fan = from_.mode == TINYGLTF_MODE_TRIANGLE_FAN;
            for (size_t i = 0; i + 2 < count; ++i) {
                if (fan) {
                    to.triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
                } else {
                    to.triangles.push_back({indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
                }
            }
        }
        keep_used(to);
    }

    void keep_used(PrimitiveData& to) {
        std::vector<uint32_t> number(vertex_count(), kUnused);
        for (const auto& triangle : to.triangles) {
            for (const uint32_t vertex : triangle) number[vertex] = 0;
        }
        for (size_t i = 0; i < number.size(); ++i) {
            if (number[i] == kUnused) continue;
            number[i] = static_cast<uint32_t>(used_.size());
            used_.push_back(static_cast<uint32_t>(i));
        }
        for (auto& triangle : to.triangles) {
            for (uint32_t& vertex : triangle) vertex = number[vertex];
        }
    }

    // Three numbers for each used vertex.
    std::vector<glm::vec3> read_vectors(int number) const {
        const std::vector<float> values = read_floats(document_, number);
        std::vector<glm::vec3> result;
        result.reserve(used_.size());
        for (const uint32_t i : used_) result.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
        return result;
    }

    void require_finite(const std::vector<glm::vec3>& vectors, const std::string& what) const {
        uint64_t bad = 0;
        for (const glm::vec3 v : vectors) bad += is_finite(v) ? 0 : 1;
        if (bad != 0)
            fail(what + " of " + std::to_string(bad) + " of " + std::to_string(vectors.size()) + " vertices are not finite");
    }

    void read_positions(PrimitiveData& to) const {
        const std::vector<glm::vec3> positions = read_vectors(attribute(from_.attributes, "POSITION"));
        require_finite(positions, "positions");
        for (size_t i = 0; i < positions.size(); ++i) to.vertices[i].position = positions[i];
    }

    void read_normals(PrimitiveData& to) {
        const int number = attribute(from_.attributes, "NORMAL");
        if (number < 0) return;
        const std::vector<glm::vec3> normals = read_vectors(number);
        for (size_t i = 0; i < normals.size(); ++i) {
            const double length = glm::length(glm::dvec3(normals[i]));
            const bool good = std::isfinite(length) && length > 0.0;
            if (good) to.vertices[i].normal = glm::dvec3(normals[i]) / length;
            report_.bad_normals += good ? 0 : 1;
        }
    }

    void read_uvs(const Materials& materials, PrimitiveData& to) {
        const UvTransform& transform = materials.uv[to.material];
        const int number = attribute(from_.attributes, "TEXCOORD_" + std::to_string(transform.set));
        if (number < 0) {
            report_.missing_uvs += materials.materials[to.material].image >= 0 ? 1 : 0;
            return;
        }
        const std::vector<float> values = read_floats(document_, number);
        for (size_t i = 0; i < used_.size(); ++i) {
            const glm::vec2 uv = transform({values[2 * used_[i]], values[2 * used_[i] + 1]});
            const bool good = std::isfinite(uv.x) && std::isfinite(uv.y);
            if (good) to.vertices[i].uv = uv;
            report_.bad_uvs += good ? 0 : 1;
        }
    }

    void read_colors(PrimitiveData& to) {
        const int number = attribute(from_.attributes, "COLOR_0");
        if (number < 0) return;
        const std::vector<float> values = read_floats(document_, number);
        const uint32_t width = width_of(accessor(number));
        for (size_t i = 0; i < used_.size(); ++i) {
            bool clamped = false;
            for (uint32_t c = 0; c < width; ++c) {
                const float stored = values[used_[i] * width + c];
                const float value = stored > 0.0f ? std::min(stored, 1.0f) : 0.0f;  // NaN too.
                clamped = clamped || !(value == stored);
                to.vertices[i].color[static_cast<int>(c)] = value;
            }
            report_.clamped_colors += clamped ? 1 : 0;
        }
    }

    // All JOINTS_n and WEIGHTS_n. A weight that is negative or not finite counts as 0; a vertex without any follows its first
    // joint.
    void read_influences(PrimitiveData& to) {
        std::vector<std::vector<uint32_t>> joints;
        std::vector<std::vector<float>> weights;
        for (uint32_t set = 0; attribute(from_.attributes, "JOINTS_" + std::to_string(set)) >= 0; ++set) {
            joints.push_back(read_unsigned(document_, attribute(from_.attributes, "JOINTS_" + std::to_string(set))));
            weights.push_back(read_floats(document_, attribute(from_.attributes, "WEIGHTS_" + std::to_string(set))));
        }
        if (joints.empty()) return;
        for (const uint32_t vertex : used_) {
            const size_t first = to.influences.size();
            to.influence_first.push_back(static_cast<uint32_t>(first));
            double sum = 0.0;
            for (size_t set = 0; set < joints.size(); ++set) {
                for (size_t i = size_t{4} * vertex; i < size_t{4} * vertex + 4; ++i) {
                    const float weight = weights[set][i];
                    const bool good = std::isfinite(weight) && weight >= 0.0f;
                    report_.bad_weights += good ? 0 : 1;
                    if (!good || weight == 0.0f) continue;
                    to.influences.push_back({joints[set][i], weight});
                    sum += double{weight};
                }
            }
            if (to.influences.size() == first) {
                ++report_.unweighted_vertices;
                to.influences.push_back({joints[0][size_t{4} * vertex], 1.0f});
                sum = 1.0;
            }
            for (size_t i = first; i < to.influences.size(); ++i) {
                to.influences[i].weight = static_cast<float>(double{to.influences[i].weight} / sum);
            }
        }
        to.influence_first.push_back(static_cast<uint32_t>(to.influences.size()));
    }

    void read_targets(PrimitiveData& to) const {
        to.target_count = static_cast<uint32_t>(from_.targets.size());
        const auto read_deltas = [&](const std::map<std::string, int>& target, const std::string& name) {
            const int number = attribute(target, name);
            std::vector<glm::vec3> deltas(used_.size(), glm::vec3(0.0f));
            if (number >= 0) deltas = read_vectors(number);
            require_finite(deltas, "morph targets' " + name);
            return deltas;
        };
        for (const std::map<std::string, int>& target : from_.targets) {
            const std::vector<glm::vec3> positions = read_deltas(target, "POSITION");
            const std::vector<glm::vec3> normals = read_deltas(target, "NORMAL");
            to.delta_positions.insert(to.delta_positions.end(), positions.begin(), positions.end());
            to.delta_normals.insert(to.delta_normals.end(), normals.begin(), normals.end());
        }
    }

    const Document& document_;
    const tinygltf::Primitive& from_;
    std::string where_;
    std::string label_;
    MeshReport& report_;
    std::vector<uint32_t> used_;  // The file's numbers of the vertices kept.
};

bool has_triangles(const tinygltf::Primitive& primitive) { return primitive.mode >= TINYGLTF_MODE_TRIANGLES; }

}  // namespace

void MeshReport::write(std::vector<std::string>& warnings) const {
    const auto line = [&](uint64_t count, const std::string& what) {
        if (count != 0) warnings.push_back(std::to_string(count) + " " + what);
    };
    line(point_or_line_primitives, "primitives of points or lines are ignored");
    line(primitives_without_positions, "primitives without positions are ignored");
    line(leftover_indices, "indices left over that make no whole triangle are ignored");
    line(bad_normals, "normals are zero or not finite: their triangles' own normals are used");
    line(bad_uvs, "texture coordinates are not finite: (0, 0) is used");
    line(missing_uvs, "textured primitives lack the texture coordinates of their material: (0, 0) is used");
    line(clamped_colors, "vertex colours are outside 0 to 1: clamped");
    line(bad_weights, "joint weights are negative or not finite: 0 is used");
    line(unweighted_vertices, "vertices have no joint weight: they follow their first joint");
    line(primitives_without_joints, "skinned primitives have no joints: they follow their node");
}

PrimitiveBound bound_of(const Document& document, const tinygltf::Primitive& primitive) {
    PrimitiveBound bound;
    const int position = attribute(primitive.attributes, "POSITION");
    if (position < 0) return bound;
    const auto& accessors = document.model.accessors;
    const uint64_t vertex_count = accessors[static_cast<size_t>(position)].count;
    const uint64_t indices = primitive.indices < 0 ? vertex_count : accessors[static_cast<size_t>(primitive.indices)].count;
    bound.decoded_bytes = indices * sizeof(uint32_t);
    if (!has_triangles(primitive)) return bound;
    bound.vertices = std::min(vertex_count, indices);
    bound.triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ? indices / 3 : indices;
    bound.decoded_bytes += bound.triangles * 3 * sizeof(uint32_t);
    bound.deltas = bound.vertices * primitive.targets.size();
    for (const auto& [name, number] : primitive.attributes) {
        bound.decoded_bytes += float_bytes(accessors[static_cast<size_t>(number)]);
        if (name.starts_with("JOINTS_")) bound.influences += 4 * bound.vertices;
    }
    bound.decoded_bytes += bound.deltas * 2 * sizeof(glm::vec3);
    return bound;
}

std::optional<PrimitiveData> read_primitive(const Document& document, size_t mesh, size_t primitive, const Materials& materials,
                                            MeshReport& report) {
    const tinygltf::Primitive& from = document.model.meshes[mesh].primitives[primitive];
    if (attribute(from.attributes, "POSITION") < 0) {
        ++report.primitives_without_positions;
        return std::nullopt;
    }
    Reader reader(document, mesh, primitive, report);
    if (!has_triangles(from)) {
        ++report.point_or_line_primitives;
        if (from.indices >= 0) reader.read_indices();  // Out of range, they are an error there, too.
        return std::nullopt;
    }
    return reader.read(materials);
}

}  // namespace gnomon::gltf
