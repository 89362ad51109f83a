// SPDX-License-Identifier: Apache-2.0
#include "scene_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace gnomon::makers {

std::vector<Triangle> triangles_of(const Scene& scene, const std::string& material) {
    std::vector<Triangle> found;
    for (const Triangle& t : scene.triangles) {
        if (scene.materials[t.material].name == material) found.push_back(t);
    }
    EXPECT_FALSE(found.empty()) << material;
    return found;
}

std::vector<uint32_t> vertices_of(const Scene& scene, const std::string& material) {
    std::set<uint32_t> used;
    for (const Triangle& t : triangles_of(scene, material)) used.insert(std::begin(t.vertex), std::end(t.vertex));
    return {used.begin(), used.end()};
}

void expect_closed(const Scene& scene, const std::string& material) {
    using Place = std::tuple<float, float, float, uint32_t>;
    std::map<Place, uint32_t> numbers;
    const auto number = [&](uint32_t v) {
        const Vertex& vertex = scene.vertices[v];
        const Place place{vertex.position.x, vertex.position.y, vertex.position.z,
                          scene.influences[vertex.influence_first].matrix};
        return numbers.try_emplace(place, static_cast<uint32_t>(numbers.size())).first->second;
    };
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    double volume = 0.0;
    for (const Triangle& t : triangles_of(scene, material)) {
        for (int corner = 0; corner < 3; ++corner) {
            ++edges[{number(t.vertex[corner]), number(t.vertex[(corner + 1) % 3])}];
        }
        const glm::dvec3 a = scene.vertices[t.vertex[0]].position, b = scene.vertices[t.vertex[1]].position,
                         c = scene.vertices[t.vertex[2]].position;
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    int wrong = 0;
    for (const auto& [edge, count] : edges) {
        const auto opposite = edges.find({edge.second, edge.first});
        wrong += edge.first == edge.second || count != 1 || opposite == edges.end() || opposite->second != 1;
    }
    EXPECT_EQ(wrong, 0) << material << ": edges that are not shared by two triangles, of " << edges.size();
    EXPECT_GT(volume, 0.0) << material;
}

std::vector<Pose> default_shutter(const Scene& scene) { return pose_scene(scene, kFirstAnimation, 0.0, kShutterSeconds, 1); }

std::vector<glm::dvec3> motions(const Scene& scene, const std::vector<uint32_t>& vertices) {
    const auto poses = default_shutter(scene);
    const auto open = posed_positions(scene, poses[0]), close = posed_positions(scene, poses[1]);
    std::vector<glm::dvec3> found;
    for (const uint32_t v : vertices) found.push_back(glm::dvec3(close[v]) - glm::dvec3(open[v]));
    return found;
}

std::vector<double> displacements(const Scene& scene, const std::string& material) {
    std::vector<double> lengths;
    for (const glm::dvec3& motion : motions(scene, vertices_of(scene, material))) lengths.push_back(glm::length(motion));
    return lengths;
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

glm::dvec3 mean(const std::vector<glm::dvec3>& values) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

}  // namespace gnomon::makers
