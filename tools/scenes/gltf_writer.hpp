// SPDX-License-Identifier: Apache-2.0
// Collects the parts of a glTF 2.0 asset and writes it as .gltf with a .bin beside it, or as .glb.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry.hpp"
#include "mesh.hpp"

namespace gnomon::makers {

struct Rgb {
    double r = 1.0, g = 1.0, b = 1.0;
};

/// A mesh and the material of all its triangles.
struct Primitive {
    const Mesh* mesh = nullptr;
    int material = 0;
};

/// Where a node stands relative to its parent.
struct Placement {
    Vec3 translation;
    Quat rotation;
};

/// Every method that adds something returns its index. Nodes are roots unless parented.
class GltfWriter {
public:
    explicit GltfWriter(std::string title);

    /// image: index from add_image, or -1.
    int add_material(const std::string& name, Rgb color, int image = -1);
    /// Repeated, bilinear.
    int add_image(const std::string& name, std::span<const uint8_t> png);
    int add_mesh(const std::string& name, std::span<const Primitive> primitives);

    int add_node(const std::string& name, const Placement& placement = {}, int parent = -1);
    int add_mesh_node(const std::string& name, int mesh, const Placement& placement = {}, int parent = -1);
    /// The bind poses are pure translations: joint i stands at bind_positions[i] in the mesh's space.
    int add_skinned_node(const std::string& name, int mesh, std::span<const int> joints, std::span<const Vec3> bind_positions);

    /// The camera looks from `eye` at `target`; yfov in radians.
    int add_camera(const std::string& name, Vec3 eye, Vec3 target, double yfov, double aspect, double znear, double zfar);
    /// `lux` on a surface that faces the light. It shines along `direction` and stands at `position`, which does not matter.
    int add_directional_light(const std::string& name, Vec3 direction, Vec3 position, Rgb color, double lux);
    /// Cone angles in radians from the axis.
    int add_spot_light(const std::string& name, const Placement& placement, Rgb color, double candela, double inner,
                       double outer);

    /// LINEAR key frames of one node; `times` (from add_times) has as many keys as there are values. All are in one animation.
    int add_times(std::span<const double> seconds);
    void animate_translation(int node, int times, std::span<const Vec3> values);
    void animate_rotation(int node, int times, std::span<const Quat> values);

    /// By the extension of `path`: .gltf with a .bin of the same name beside it, or .glb. Needs at least one animated node.
    /// Files are written whole or not at all. Errors: ErrorKind::usage for another extension, ErrorKind::input if a file cannot
    /// be written.
    void write(const std::filesystem::path& path) const;

private:
    using Json = nlohmann::ordered_json;

    int add_element(const char* array, Json element);
    int add_light_node(const std::string& name, const Placement& placement, Json light);
    /// Data that only the program reads (animations, inverse bind matrices) shares buffer view 0.
    int add_data(std::span<const float> values, std::size_t components, const char* type, bool bounds);
    int add_attribute(const void* values, std::size_t bytes, std::size_t count, int component_type, const char* type,
                      bool normalized, int target);
    int add_vectors(std::span<const Vec3> values, bool bounds);
    int add_indices(std::span<const uint32_t> indices, std::size_t vertex_count);
    void add_channel(int node, const char* path, int times, int values);

    Json document_;
    std::vector<uint8_t> data_;
    std::vector<uint8_t> geometry_;
};

}  // namespace gnomon::makers
