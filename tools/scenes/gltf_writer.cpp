// SPDX-License-Identifier: Apache-2.0
// Collects the parts of a glTF 2.0 asset and writes it.
// Based on: glTF 2.0 specification (ISO/IEC 12113:2022) and KHR_lights_punctual.
#include "gltf_writer.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <gnomon/error.hpp>

#include "io/atomic_file.hpp"
#include "png.hpp"

namespace gnomon::makers {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertices = 34962, kIndices = 34963;

nlohmann::ordered_json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
nlohmann::ordered_json json_of(Quat q) { return {q.x, q.y, q.z, q.w}; }
nlohmann::ordered_json json_of(Rgb c) { return {c.r, c.g, c.b}; }

std::vector<float> floats_of(std::span<const Vec3> values) {
    std::vector<float> floats;
    floats.reserve(values.size() * 3);
    for (const Vec3& v : values) {
        for (const double component : {v.x, v.y, v.z}) floats.push_back(static_cast<float>(component));
    }
    return floats;
}

void append_aligned(std::vector<uint8_t>& to, const void* from, std::size_t bytes) {
    const auto* first = static_cast<const uint8_t*>(from);
    to.insert(to.end(), first, first + bytes);
    to.resize((to.size() + 3) / 4 * 4, 0);
}

/// Least and largest of each component, as the exact floats.
void add_bounds(nlohmann::ordered_json& accessor, std::span<const float> values, std::size_t components) {
    for (std::size_t c = 0; c < components; ++c) {
        float low = values[c], high = values[c];
        for (std::size_t i = c; i < values.size(); i += components) {
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
        }
        accessor["min"].push_back(low);
        accessor["max"].push_back(high);
    }
}

/// A file name as a URI: everything but unreserved characters percent-encoded (RFC 3986).
std::string uri_of(const std::string& file_name) {
    static constexpr std::string_view kHex = "0123456789ABCDEF", kMarks = "-._~";
    std::string uri;
    for (const char c : file_name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool alphanumeric = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
        if (alphanumeric || kMarks.find(c) != std::string_view::npos) {
            uri.push_back(c);
        } else {
            uri.insert(uri.end(), {'%', kHex[byte >> 4], kHex[byte & 15u]});
        }
    }
    return uri;
}

std::string_view text_of(const std::vector<uint8_t>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

GltfWriter::GltfWriter(std::string title) {
    document_["asset"] = {{"version", "2.0"}, {"generator", "gnomon make_scenes"}};
    document_["scene"] = 0;
    document_["scenes"] = Json::array({{{"name", std::move(title)}, {"nodes", Json::array()}}});
    document_["bufferViews"] = Json::array({{{"buffer", 0}, {"byteOffset", 0}}});
}

int GltfWriter::add_element(const char* array, Json element) {
    document_[array].push_back(std::move(element));
    return static_cast<int>(document_[array].size()) - 1;
}

int GltfWriter::add_image(const std::string& name, std::span<const uint8_t> png) {
    if (!document_.contains("samplers")) {
        add_element("samplers", {{"magFilter", 9729}, {"minFilter", 9729}, {"wrapS", 10497}, {"wrapT", 10497}});
    }
    const int image = add_element("images", {{"name", name}, {"uri", png_data_uri(png)}});
    return add_element("textures", {{"sampler", 0}, {"source", image}});
}

int GltfWriter::add_material(const std::string& name, Rgb color, int image) {
    Json surface = {{"baseColorFactor", {color.r, color.g, color.b, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
    if (image >= 0) surface["baseColorTexture"] = {{"index", image}};
    return add_element("materials", {{"name", name}, {"pbrMetallicRoughness", std::move(surface)}});
}

int GltfWriter::add_data(std::span<const float> values, std::size_t components, const char* type, bool bounds) {
    Json accessor = {{"bufferView", 0},
                     {"byteOffset", data_.size()},
                     {"componentType", kFloat},
                     {"count", values.size() / components},
                     {"type", type}};
    if (bounds) add_bounds(accessor, values, components);
    append_aligned(data_, values.data(), values.size_bytes());
    return add_element("accessors", std::move(accessor));
}

int GltfWriter::add_attribute(const void* values, std::size_t bytes, std::size_t count, int component_type, const char* type,
                              bool normalized, int target) {
    const int view = add_element("bufferViews",
                                 {{"buffer", 0}, {"byteOffset", geometry_.size()}, {"byteLength", bytes}, {"target", target}});
    append_aligned(geometry_, values, bytes);
    Json accessor = {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return add_element("accessors", std::move(accessor));
}

int GltfWriter::add_vectors(std::span<const Vec3> values, bool bounds) {
    const std::vector<float> floats = floats_of(values);
    const int accessor =
        add_attribute(floats.data(), floats.size() * sizeof(float), values.size(), kFloat, "VEC3", false, kVertices);
    if (bounds) add_bounds(document_["accessors"][static_cast<std::size_t>(accessor)], floats, 3);
    return accessor;
}

int GltfWriter::add_indices(std::span<const uint32_t> indices, std::size_t vertex_count) {
    if (vertex_count > 0xffffu) {  // The index 0xffff itself is not allowed in 16 bits.
        return add_attribute(indices.data(), indices.size_bytes(), indices.size(), kUnsignedInt, "SCALAR", false, kIndices);
    }
    const std::vector<uint16_t> narrow(indices.begin(), indices.end());
    return add_attribute(narrow.data(), narrow.size() * sizeof(uint16_t), narrow.size(), kUnsignedShort, "SCALAR", false,
                         kIndices);
}

int GltfWriter::add_mesh(const std::string& name, std::span<const Primitive> primitives) {
    Json list = Json::array();
    for (const Primitive& primitive : primitives) {
        const Mesh& mesh = *primitive.mesh;
        const std::size_t count = mesh.positions.size();
        Json attributes = {{"POSITION", add_vectors(mesh.positions, true)}, {"NORMAL", add_vectors(mesh.normals, false)}};
        if (!mesh.uvs.empty()) {
            std::vector<float> uvs;
            for (const auto& uv : mesh.uvs) {
                for (const double component : uv) uvs.push_back(static_cast<float>(component));
            }
            attributes["TEXCOORD_0"] =
                add_attribute(uvs.data(), uvs.size() * sizeof(float), count, kFloat, "VEC2", false, kVertices);
        }
        if (!mesh.colors.empty()) {
            attributes["COLOR_0"] =
                add_attribute(mesh.colors.data(), count * sizeof(Rgba), count, kUnsignedByte, "VEC4", true, kVertices);
        }
        if (!mesh.joints.empty()) {
            attributes["JOINTS_0"] =
                add_attribute(mesh.joints.data(), count * 8, count, kUnsignedShort, "VEC4", false, kVertices);
            attributes["WEIGHTS_0"] = add_attribute(mesh.weights.data(), count * 16, count, kFloat, "VEC4", false, kVertices);
        }
        list.push_back({{"attributes", std::move(attributes)},
                        {"indices", add_indices(mesh.indices, count)},
                        {"material", primitive.material}});
    }
    return add_element("meshes", {{"name", name}, {"primitives", std::move(list)}});
}

int GltfWriter::add_node(const std::string& name, const Placement& placement, int parent) {
    Json node = {{"name", name}};
    if (placement.translation != Vec3{}) node["translation"] = json_of(placement.translation);
    if (placement.rotation.w != 1.0) node["rotation"] = json_of(placement.rotation);
    const int index = add_element("nodes", std::move(node));
    if (parent < 0) {
        document_["scenes"][0]["nodes"].push_back(index);
    } else {
        document_["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(index);
    }
    return index;
}

int GltfWriter::add_mesh_node(const std::string& name, int mesh, const Placement& placement, int parent) {
    const int node = add_node(name, placement, parent);
    document_["nodes"][static_cast<std::size_t>(node)]["mesh"] = mesh;
    return node;
}

int GltfWriter::add_skinned_node(const std::string& name, int mesh, std::span<const int> joints,
                                 std::span<const Vec3> bind_positions) {
    assert(joints.size() == bind_positions.size());
    std::vector<float> inverse;
    for (const Vec3& p : bind_positions) {
        const auto x = static_cast<float>(-p.x), y = static_cast<float>(-p.y), z = static_cast<float>(-p.z);
        inverse.insert(inverse.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1});
    }
    const int skin = add_element("skins", {{"name", name},
                                           {"inverseBindMatrices", add_data(inverse, 16, "MAT4", false)},
                                           {"joints", std::vector<int>(joints.begin(), joints.end())}});
    const int node = add_mesh_node(name, mesh);
    document_["nodes"][static_cast<std::size_t>(node)]["skin"] = skin;
    return node;
}

int GltfWriter::add_camera(const std::string& name, Vec3 eye, Vec3 target, double yfov, double aspect, double znear,
                           double zfar) {
    const int camera =
        add_element("cameras", {{"name", name},
                                {"type", "perspective"},
                                {"perspective", {{"aspectRatio", aspect}, {"yfov", yfov}, {"znear", znear}, {"zfar", zfar}}}});
    const int node = add_node(name, {eye, look_rotation(target - eye, {0.0, 1.0, 0.0})});
    document_["nodes"][static_cast<std::size_t>(node)]["camera"] = camera;
    return node;
}

int GltfWriter::add_light_node(const std::string& name, const Placement& placement, Json light) {
    static constexpr const char* kExtension = "KHR_lights_punctual";
    document_["extensionsUsed"] = Json::array({kExtension});
    Json& lights = document_["extensions"][kExtension]["lights"];
    lights.push_back(std::move(light));
    const int node = add_node(name, placement);
    document_["nodes"][static_cast<std::size_t>(node)]["extensions"][kExtension] = {{"light", lights.size() - 1}};
    return node;
}

int GltfWriter::add_directional_light(const std::string& name, Vec3 direction, Vec3 position, Rgb color, double lux) {
    return add_light_node(name, {position, look_rotation(direction, {0.0, 1.0, 0.0})},
                          {{"name", name}, {"type", "directional"}, {"color", json_of(color)}, {"intensity", lux}});
}

int GltfWriter::add_spot_light(const std::string& name, const Placement& placement, Rgb color, double candela, double inner,
                               double outer) {
    return add_light_node(name, placement,
                          {{"name", name},
                           {"type", "spot"},
                           {"color", json_of(color)},
                           {"intensity", candela},
                           {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}});
}

int GltfWriter::add_times(std::span<const double> seconds) {
    std::vector<float> floats;
    for (const double s : seconds) floats.push_back(static_cast<float>(s));
    return add_data(floats, 1, "SCALAR", true);
}

void GltfWriter::add_channel(int node, const char* path, int times, int values) {
    if (!document_.contains("animations")) {
        add_element("animations", {{"name", "motion"}, {"channels", Json::array()}, {"samplers", Json::array()}});
    }
    Json& animation = document_["animations"][0];
    animation["channels"].push_back({{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", times}, {"output", values}});
}

void GltfWriter::animate_translation(int node, int times, std::span<const Vec3> values) {
    add_channel(node, "translation", times, add_data(floats_of(values), 3, "VEC3", false));
}

void GltfWriter::animate_rotation(int node, int times, std::span<const Quat> values) {
    std::vector<float> floats;
    for (const Quat& q : values) {
        for (const double component : {q.x, q.y, q.z, q.w}) floats.push_back(static_cast<float>(component));
    }
    add_channel(node, "rotation", times, add_data(floats, 4, "VEC4", false));
}

void GltfWriter::write(const std::filesystem::path& path) const {
    assert(!data_.empty());
    const bool binary = path.extension() == ".glb";
    if (!binary && path.extension() != ".gltf") {
        throw Error(ErrorKind::usage, "unknown kind of scene file", path.string(), "end the name in .gltf or .glb");
    }
    Json document = document_;
    Json& views = document["bufferViews"];
    views[0]["byteLength"] = data_.size();
    for (std::size_t i = 1; i < views.size(); ++i) {
        views[i]["byteOffset"] = views[i]["byteOffset"].get<std::size_t>() + data_.size();
    }
    std::vector<uint8_t> buffer = data_;
    buffer.insert(buffer.end(), geometry_.begin(), geometry_.end());
    document["buffers"] = Json::array({{{"byteLength", buffer.size()}}});

    if (!binary) {
        const std::filesystem::path buffer_path = std::filesystem::path(path).replace_extension(".bin");
        document["buffers"][0]["uri"] = uri_of(buffer_path.filename().string());
        io::write_file(buffer_path, text_of(buffer));
        io::write_file(path, document.dump(1) + "\n");
        return;
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<uint8_t> file;
    const auto put = [&](std::size_t value) {
        const auto word = static_cast<uint32_t>(value);
        append_aligned(file, &word, sizeof(word));
    };
    put(0x46546c67);  // "glTF"
    put(2);
    put(12 + 8 + text.size() + 8 + buffer.size());
    put(text.size());
    put(0x4e4f534a);  // "JSON"
    append_aligned(file, text.data(), text.size());
    put(buffer.size());
    put(0x004e4942);  // "BIN"
    append_aligned(file, buffer.data(), buffer.size());
    io::write_file(path, text_of(file));
}

}  // namespace gnomon::makers
