// SPDX-License-Identifier: Apache-2.0
// Moving triangles given in raster space. Each vertex has a palette matrix of its own, which holds nothing but its place.
#include "soup.hpp"

namespace gnomon::test {

Soup::Soup(uint32_t segments, uint32_t width_px, uint32_t height_px, bool is_orthographic)
    : width(width_px), height(height_px), orthographic(is_orthographic), keys(segments + 1) {}

uint32_t Soup::add_vertex(const std::vector<glm::vec4>& places) {
    for (size_t k = 0; k < keys.size(); ++k) keys[k].push_back(places[k]);
    return static_cast<uint32_t>(keys[0].size()) - 1;
}

void Soup::add_prism(const oracle::Prism& prism) {
    glm::uvec3 triangle;
    for (size_t i = 0; i < 3; ++i) {
        std::vector<glm::vec4> places;
        for (size_t k = 0; k < keys.size(); ++k) {
            glm::vec4 p = glm::mix(prism.start[i], prism.end[i], float(k) / float(segments()));
            if (orthographic) {
                p.w = 1.0f;
            } else {
                p.z = -1.0f;
            }
            places.push_back(p);
        }
        triangle[static_cast<int>(i)] = add_vertex(places);
    }
    triangles.push_back(triangle);
}

void Soup::add_prisms(uint32_t count, std::mt19937& random) {
    std::uniform_int_distribution<uint32_t> column(0, width - 1), row(0, height - 1);
    for (uint32_t i = 0; i < count; ++i) {
        const auto kind = static_cast<oracle::PrismKind>(i % oracle::kPrismKinds);
        const uint32_t x = column(random);
        const glm::dvec2 texel = glm::dvec2(x, row(random)) - 0.5 * glm::dvec2(width, height);
        add_prism(oracle::make_prism(kind, orthographic, texel, random));
    }
}

void Soup::hold_every(uint32_t n) {
    for (size_t i = 0; i < triangles.size(); i += n) {
        for (auto& places : keys) {
            for (int k = 0; k < 3; ++k) places[triangles[i][k]] = keys[0][triangles[i][k]];
        }
    }
}

oracle::MovingTriangle Soup::triangle(uint32_t index, uint32_t segment) const {
    oracle::MovingTriangle result;
    for (size_t i = 0; i < 3; ++i) {
        const uint32_t vertex = triangles[index][static_cast<int>(i)];
        result.start[i] = glm::dvec4(keys[segment][vertex]);
        result.end[i] = glm::dvec4(keys[segment + 1][vertex]);
    }
    return result;
}

std::vector<oracle::MovingTriangle> Soup::all_triangles(uint32_t segment) const {
    std::vector<oracle::MovingTriangle> result;
    for (uint32_t i = 0; i < triangles.size(); ++i) result.push_back(triangle(i, segment));
    return result;
}

Scene Soup::scene() const {
    Scene scene;
    scene.morphs.emplace_back();
    scene.materials.emplace_back();
    for (uint32_t v = 0; v < keys[0].size(); ++v) {
        Vertex vertex;
        vertex.influence_first = v;
        vertex.influence_count = 1;
        scene.vertices.push_back(vertex);
        scene.influences.push_back({v, 1.0f});
    }
    for (const glm::uvec3& t : triangles) scene.triangles.push_back({{t.x, t.y, t.z}, 0});
    return scene;
}

std::vector<Pose> Soup::poses() const {
    std::vector<Pose> poses;
    for (const auto& key : keys) {
        Pose pose;
        for (const glm::vec4& p : key) {
            for (float coordinate : {p.x, p.y, orthographic ? p.z : p.w})
                pose.palette.emplace_back(0.0f, 0.0f, 0.0f, coordinate);
        }
        poses.push_back(std::move(pose));
    }
    return poses;
}

View Soup::view() const {
    View view;
    view.width = width;
    view.height = height;
    view.orthographic = orthographic;
    view.depth_near = -3.4e38f;
    view.depth_far = orthographic ? 3.4e38f : 0.0f;
    const glm::vec4 third(0, 0, 1, 0), one(0, 0, 0, 1);
    const ViewKey key = orthographic ? ViewKey{{1, 0, 0, 0}, {0, 1, 0, 0}, third, one, glm::vec3(0.0f)}
                                     : ViewKey{{1, 0, 0, 0}, {0, 1, 0, 0}, -one, third, glm::vec3(0.0f)};
    view.keys.assign(keys.size(), key);
    return view;
}

}  // namespace gnomon::test
