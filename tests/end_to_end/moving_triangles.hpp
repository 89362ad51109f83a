// SPDX-License-Identifier: Apache-2.0
// Scenes of a few moving triangles, built without a file.
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon::test {

using Corners = std::array<glm::vec3, 3>;

/// A scene in its poses, ready to be rendered.
struct PosedScene {
    Scene scene;
    std::vector<Pose> poses;
};

/// Triangles that are added one after the other and move alike have one palette matrix: shells hold together.
struct MovingTriangles : PosedScene {
    explicit MovingTriangles(uint32_t segments) {
        poses.resize(segments + 1);
        scene.morphs.emplace_back();
        scene.materials.emplace_back();
    }

    /// keys: the triangle's matrix at each key. Returns the triangle's index.
    uint32_t add(const Corners& corners, const std::vector<glm::mat4>& keys) {
        const bool moves_alike = keys == last_keys_;
        const auto matrix = static_cast<uint32_t>(poses[0].palette.size() / 3) - (moves_alike ? 1 : 0);
        Triangle triangle;
        for (size_t i = 0; i < 3; ++i) {
            triangle.vertex[i] = static_cast<uint32_t>(scene.vertices.size());
            Vertex vertex;
            vertex.position = corners[i];
            vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
            vertex.influence_count = 1;
            scene.vertices.push_back(vertex);
            scene.influences.push_back({matrix, 1.0f});
        }
        scene.triangles.push_back(triangle);
        last_keys_ = keys;
        for (size_t k = 0; k < poses.size() && !moves_alike; ++k) {
            const glm::mat4 rows = glm::transpose(keys[k]);
            poses[k].palette.insert(poses[k].palette.end(), {rows[0], rows[1], rows[2]});
        }
        return static_cast<uint32_t>(scene.triangles.size()) - 1;
    }

    /// Moves by `motion` from the first key to the last, evenly.
    uint32_t add(const Corners& corners, glm::vec3 motion = glm::vec3(0.0f)) {
        std::vector<glm::mat4> keys(poses.size(), glm::mat4(1.0f));
        for (size_t k = 0; k < keys.size(); ++k) {
            keys[k][3] = glm::vec4(motion * (static_cast<float>(k) / static_cast<float>(keys.size() - 1)), 1.0f);
        }
        return add(corners, keys);
    }

    void add(const Camera& camera, const std::vector<Rigid>& keys) {
        scene.cameras.push_back(camera);
        for (size_t k = 0; k < poses.size(); ++k) poses[k].cameras.push_back(keys[std::min(k, keys.size() - 1)]);
    }

    void add(const Light& light, const std::vector<Rigid>& keys) {
        scene.lights.push_back(light);
        for (size_t k = 0; k < poses.size(); ++k) poses[k].lights.push_back(keys[std::min(k, keys.size() - 1)]);
    }

private:
    std::vector<glm::mat4> last_keys_;  ///< Of the triangle that was added last.
};

}  // namespace gnomon::test
