// SPDX-License-Identifier: Apache-2.0
// Small glTF files for tests: a document that tests edit freely, and accessors made from numbers.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gnomon/error.hpp>
#include <gnomon/scene.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace gnomon::test {

using nlohmann::json;

/// A new folder, removed with what is in it.
class TempFolder {
public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon_scene_XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Writes a file into the folder and returns its path.
    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::filesystem::path path = path_ / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }

private:
    std::filesystem::path path_;
};

template <typename T>
constexpr int component_type() {
    if constexpr (std::is_same_v<T, float>) return 5126;
    if constexpr (std::is_same_v<T, uint32_t>) return 5125;
    if constexpr (std::is_same_v<T, uint16_t>) return 5123;
    if constexpr (std::is_same_v<T, int16_t>) return 5122;
    if constexpr (std::is_same_v<T, uint8_t>) return 5121;
    if constexpr (std::is_same_v<T, int8_t>) return 5120;
}

class Gltf {
public:
    json doc = {{"asset", {{"version", "2.0"}}}};

    /// A view of these numbers at a multiple of four bytes. Returns its index.
    template <typename T>
    int view(const std::vector<T>& values) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        doc["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
        const size_t at = bytes_.size();
        bytes_.resize(at + values.size() * sizeof(T));
        std::memcpy(bytes_.data() + at, values.data(), values.size() * sizeof(T));
        return static_cast<int>(doc["bufferViews"].size()) - 1;
    }

    /// An accessor of these numbers, packed. Returns its index.
    template <typename T>
    int accessor(const std::string& type, const std::vector<T>& values, bool normalized = false) {
        const size_t width = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type[3] - '0');
        json accessor = {{"bufferView", view(values)},
                         {"componentType", component_type<T>()},
                         {"type", type},
                         {"count", values.size() / width}};
        if (normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }

    /// Appends to a collection of the document. Returns the index.
    int add(const std::string& collection, const json& item) {
        doc[collection].push_back(item);
        return static_cast<int>(doc[collection].size()) - 1;
    }

    /// A mesh of one primitive, and a node with it.
    int add_mesh_node(const json& primitive) {
        return add("nodes", {{"mesh", add("meshes", {{"primitives", json::array({primitive})}})}});
    }

    /// The triangle (0,0,0), (1,0,0), (0,1,0) as a mesh with a node. Returns the node.
    int add_triangle() { return add_mesh_node({{"attributes", {{"POSITION", accessor<float>("VEC3", kTriangle)}}}}); }

    std::filesystem::path write() {
        if (!bytes_.empty() && !doc.contains("buffers")) {
            doc["buffers"] = json::array({{{"uri", "data.bin"}, {"byteLength", bytes_.size()}}});
        }
        folder.write("data.bin", std::string(bytes_.begin(), bytes_.end()));
        return folder.write("scene.gltf", doc.dump());
    }

    Scene load() { return load_scene(write()); }

    /// The message with which loading fails; empty if it does not.
    std::string error() {
        try {
            load();
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::input);
            return e.what();
        }
        return "";
    }

    static inline const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    TempFolder folder;

private:
    std::vector<uint8_t> bytes_;
};

inline Pose pose_at(const Scene& scene, double seconds, AnimationChoice choice = {}) {
    return pose_scene(scene, choice, seconds, seconds, 0)[0];
}

inline std::vector<glm::vec3> positions_at(const Scene& scene, double seconds) {
    return posed_positions(scene, pose_at(scene, seconds));
}

/// Each component within `tolerance`.
MATCHER_P2(IsNear, expected, tolerance, "") {
    for (int i = 0; i < expected.length(); ++i) {
        if (!(std::abs(arg[i] - expected[i]) <= tolerance)) {
            *result_listener << "component " << i << " is " << arg[i] << ", not " << expected[i];
            return false;
        }
    }
    return true;
}

inline auto near_to(glm::vec3 expected, float tolerance = 1e-6f) { return IsNear(expected, tolerance); }

inline auto has_warning(const std::string& text) { return testing::Contains(testing::HasSubstr(text)); }

}  // namespace gnomon::test
