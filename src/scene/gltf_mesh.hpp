// SPDX-License-Identifier: Apache-2.0
// One primitive of a glTF mesh as triangles, before it is instanced by nodes.
#pragma once

#include <array>
#include <cstdint>
#include <gnomon/scene.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_document.hpp"
#include "scene/gltf_material.hpp"

namespace gnomon::gltf {

/// Only the vertices that triangles use, in the file's order.
struct PrimitiveData {
    size_t material = 0;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<Vertex> vertices;           ///< Without influences and morph.
    std::vector<uint32_t> influence_first;  ///< For each vertex and behind the last; empty without joints.
    std::vector<Influence> influences;      ///< `matrix` is the joint's number in its skin. Weights add up to 1.
    uint32_t target_count = 0;
    std::vector<glm::vec3> delta_positions;  ///< target_count * vertices.size(), target by target.
    std::vector<glm::vec3> delta_normals;
};

/// What was ignored or repaired, over all meshes.
struct MeshReport {
    uint64_t point_or_line_primitives = 0;
    uint64_t primitives_without_positions = 0;
    uint64_t leftover_indices = 0;
    uint64_t bad_normals = 0;
    uint64_t bad_uvs = 0;
    uint64_t missing_uvs = 0;
    uint64_t clamped_colors = 0;
    uint64_t bad_weights = 0;
    uint64_t unweighted_vertices = 0;
    uint64_t primitives_without_joints = 0;

    void write(std::vector<std::string>& warnings) const;
};

/// At most so many vertices and triangles, and bytes of decoded attributes; known before anything is decoded.
struct PrimitiveBound {
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    uint64_t influences = 0;  ///< With a skin.
    uint64_t deltas = 0;
    uint64_t decoded_bytes = 0;
};

PrimitiveBound bound_of(const Document& document, const tinygltf::Primitive& primitive);

/// Nothing for points, lines and primitives without positions. Errors: ErrorKind::input for vertex indices out of range and
/// positions that are not finite.
std::optional<PrimitiveData> read_primitive(const Document& document, size_t mesh, size_t primitive, const Materials& materials,
                                            MeshReport& report);

}  // namespace gnomon::gltf
