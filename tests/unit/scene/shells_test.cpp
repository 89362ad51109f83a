// SPDX-License-Identifier: Apache-2.0
// Shells on meshes made by hand.
#include "scene/shells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <random>

namespace gnomon::test {
namespace {

using testing::Each;
using testing::ElementsAre;

using Corners = std::array<glm::vec3, 3>;

constexpr glm::vec3 kOrigin{0, 0, 0}, kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

// Each triangle has vertices of its own, as at a seam of texture coordinates.
struct Mesh : Scene {
    Mesh() { morphs.emplace_back(); }

    uint32_t add_vertex(const glm::vec3& position, const std::vector<Influence>& joints = {{0, 1.0f}}) {
        Vertex vertex;
        vertex.position = position;
        vertex.uv = {static_cast<float>(vertices.size()), 0.0f};
        vertex.influence_first = static_cast<uint32_t>(influences.size());
        vertex.influence_count = static_cast<uint32_t>(joints.size());
        influences.insert(influences.end(), joints.begin(), joints.end());
        vertices.push_back(vertex);
        return static_cast<uint32_t>(vertices.size()) - 1;
    }

    void add(const Corners& corners, uint32_t matrix = 0) {
        Triangle triangle;
        for (size_t i = 0; i < 3; ++i) triangle.vertex[i] = add_vertex(corners[i], {{matrix, 1.0f}});
        triangles.push_back(triangle);
    }

    // Four triangles, normals outward if d lies behind a b c.
    void add_tetrahedron(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, size_t faces = 4) {
        const Corners all[] = {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
        for (size_t i = 0; i < faces; ++i) add(all[i]);
    }
};

TEST(Shells, ATetrahedronIsOne) {
    Mesh mesh;
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin);
    const Shells shells = find_shells(mesh);
    EXPECT_EQ(shells.count, 1u);
    EXPECT_THAT(shells.of_triangle, ElementsAre(0, 0, 0, 0));
}

TEST(Shells, AHoleMakesItNone) {
    Mesh mesh;
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin, 3);
    const Shells shells = find_shells(mesh);
    EXPECT_EQ(shells.count, 0u);
    EXPECT_THAT(shells.of_triangle, ElementsAre(0, 0, 0));
}

TEST(Shells, WindingMayBeInwardButNotMixed) {
    Mesh mesh;
    mesh.add_tetrahedron(kY, kX, kZ, kOrigin);
    EXPECT_EQ(find_shells(mesh).count, 1u);
    std::swap(mesh.triangles[2].vertex[0], mesh.triangles[2].vertex[1]);
    EXPECT_EQ(find_shells(mesh).count, 0u);
}

TEST(Shells, NothingAndAQuadAreNone) {
    Mesh mesh;
    EXPECT_EQ(find_shells(mesh).count, 0u);
    mesh.add({kOrigin, kX, kX + kY});
    mesh.add({kOrigin, kX + kY, kY});
    EXPECT_EQ(find_shells(mesh).count, 0u);
    // Both its sides: closed, but around nothing.
    mesh.add({kX, kOrigin, kX + kY});
    mesh.add({kX + kY, kOrigin, kY});
    EXPECT_EQ(find_shells(mesh).count, 0u);
}

// The edge is used twice in either direction.
TEST(Shells, TwoThatShareAnEdge) {
    Mesh mesh;
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin);
    mesh.add_tetrahedron(kX, kX + kZ, kY, {1, 1, 1});
    const Shells shells = find_shells(mesh);
    EXPECT_EQ(shells.count, 1u);
    EXPECT_THAT(shells.of_triangle, Each(0u));
}

TEST(Shells, AnOpenPartSpoilsOnlyItself) {
    Mesh mesh;
    mesh.add({glm::vec3(5, 0, 0), glm::vec3(6, 0, 0), glm::vec3(5, 1, 0)});
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin);
    // At a vertex.
    mesh.add({kX, glm::vec3(3, 0, 0), glm::vec3(3, 1, 0)});
    mesh.add_tetrahedron({11, 0, 0}, {10, 1, 0}, {10, 0, 1}, {10, 0, 0});
    Shells shells = find_shells(mesh);
    EXPECT_EQ(shells.count, 2u);
    EXPECT_THAT(shells.of_triangle, ElementsAre(2, 0, 0, 0, 0, 2, 1, 1, 1, 1));
    // At an edge.
    mesh.add({kX, kY, glm::vec3(3, 3, 0)});
    shells = find_shells(mesh);
    EXPECT_EQ(shells.count, 1u);
    EXPECT_THAT(shells.of_triangle, ElementsAre(1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 1));
}

TEST(Shells, TrianglesWithoutAreaDoNotMatter) {
    Mesh mesh;
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin);
    mesh.add({kX, kX, kY});
    mesh.add({kZ, kZ, kZ});
    Shells shells = find_shells(mesh);
    EXPECT_EQ(shells.count, 1u);
    EXPECT_THAT(shells.of_triangle, ElementsAre(0, 0, 0, 0, 1, 1));
    // Three places on a line close the gap of a T-junction.
    mesh.triangles.resize(1);
    const glm::vec3 middle = 0.5f * (kX + kY);
    mesh.add({kX, kOrigin, middle});
    mesh.add({middle, kOrigin, kY});
    mesh.add({kY, kOrigin, kZ});
    mesh.add({kZ, kOrigin, kX});
    EXPECT_EQ(find_shells(mesh).count, 0u);
    mesh.add({kY, middle, kX});
    EXPECT_EQ(find_shells(mesh).count, 0u);
    std::swap(mesh.triangles.back().vertex[0], mesh.triangles.back().vertex[1]);
    EXPECT_EQ(find_shells(mesh).count, 1u);
}

TEST(Shells, ZeroHasOneSign) {
    Mesh mesh;
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin);
    for (size_t i = 0; i < 6; ++i) {
        for (int axis = 0; axis < 3; ++axis) mesh.vertices[i].position[axis] = -std::abs(mesh.vertices[i].position[axis]);
    }
    for (size_t i = 6; i < mesh.vertices.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            float& p = mesh.vertices[i].position[axis];
            if (p != 0.0f) p = -p;
        }
    }
    EXPECT_EQ(find_shells(mesh).count, 1u);
}

// Vertices at one place at rest that need not stay together.
TEST(Shells, WhatPosesAVertexHasToBeTheSame) {
    Mesh mesh;
    mesh.add_tetrahedron(kX, kY, kZ, kOrigin);
    ASSERT_EQ(find_shells(mesh).count, 1u);
    Mesh other_node = mesh;
    for (size_t i = 0; i < 3; ++i) other_node.influences[other_node.vertices[i].influence_first].matrix = 1;
    EXPECT_EQ(find_shells(other_node).count, 0u);

    const auto skinned = [](float weight_at_seam) {
        Mesh skin;
        const glm::vec3 places[] = {kX, kY, kZ, kOrigin};
        for (const auto& place : places) skin.add_vertex(place, {{0, 0.25f}, {1, 0.75f}});
        const uint32_t seam = skin.add_vertex(kX, {{0, 1.0f - weight_at_seam}, {1, weight_at_seam}});
        skin.triangles = {{{0, 1, 2}, 0}, {{0, 3, 1}, 0}, {{1, 3, 2}, 0}, {{2, 3, seam}, 0}};
        return find_shells(skin).count;
    };
    EXPECT_EQ(skinned(0.75f), 1u);
    EXPECT_EQ(skinned(0.5f), 0u);

    const auto morphed = [](const glm::vec3& delta_at_seam, uint32_t weight_first) {
        Mesh morph;
        const glm::vec3 places[] = {kX, kY, kZ, kOrigin, kX};
        for (const auto& place : places) morph.add_vertex(place);
        morph.morphs.push_back({2, 4, 0, 7});
        morph.morphs.push_back({2, 1, 8, weight_first});
        morph.morph_positions.assign(10, kY);
        morph.morph_positions[4] = kZ;
        morph.morph_positions[9] = delta_at_seam;
        for (uint32_t v = 0; v < 4; ++v) {
            morph.vertices[v].morph = 1;
            morph.vertices[v].morph_vertex = v;
        }
        morph.vertices[4].morph = 2;
        morph.triangles = {{{0, 1, 2}, 0}, {{0, 3, 1}, 0}, {{1, 3, 2}, 0}, {{2, 3, 4}, 0}};
        return find_shells(morph).count;
    };
    EXPECT_EQ(morphed(kZ, 7), 1u);
    EXPECT_EQ(morphed(kX, 7), 0u);
    EXPECT_EQ(morphed(kZ, 8), 0u);
}

// Vertices that differ in nothing but a weight, all at one place.
TEST(Shells, ManyVerticesAtOnePlace) {
    Mesh mesh;
    for (uint32_t i = 0; i < 100'000; ++i) mesh.add_vertex(kX, {{0, 1.0f}, {1, static_cast<float>(i)}});
    for (uint32_t i = 0; i + 2 < 100'000; ++i) mesh.triangles.push_back({{0, i + 1, i + 2}, 0});
    EXPECT_EQ(find_shells(mesh).count, 0u);
}

// A grid on a torus: 2 n^2 triangles, in any order.
TEST(Shells, AMillionTriangles) {
    constexpr uint32_t kSide = 708;
    Mesh mesh;
    const auto vertex = [&](uint32_t i, uint32_t j) { return i % kSide * kSide + j % kSide; };
    for (uint32_t i = 0; i < kSide; ++i) {
        for (uint32_t j = 0; j < kSide; ++j) mesh.add_vertex({static_cast<float>(i), static_cast<float>(j), 0.5f});
    }
    for (uint32_t i = 0; i < kSide; ++i) {
        for (uint32_t j = 0; j < kSide; ++j) {
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}, 0});
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, 0});
        }
    }
    std::mt19937 random(5);
    for (const bool shuffled : {false, true}) {
        if (shuffled) std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
        const std::clock_t start = std::clock();
        const Shells shells = find_shells(mesh);
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        std::cout << mesh.triangles.size() << (shuffled ? " triangles, shuffled: " : " triangles: ") << seconds << " CPU s\n";
        EXPECT_EQ(shells.count, 1u);
        EXPECT_EQ(std::count(shells.of_triangle.begin(), shells.of_triangle.end(), 0u), std::ssize(mesh.triangles));
    }
    mesh.triangles.pop_back();
    EXPECT_EQ(find_shells(mesh).count, 0u);
}

}  // namespace
}  // namespace gnomon::test
