// SPDX-License-Identifier: Apache-2.0
// Triangle meshes of the scene makers.
#include "mesh.hpp"

#include <algorithm>
#include <cassert>

namespace gnomon::makers {
namespace {

template <class T>
void append_to(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

void add_ring(Mesh& mesh, const Ring& ring, uint32_t sides) {
    for (uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * kPi * i / sides;
        mesh.positions.push_back(ring.center + ring.a * std::cos(angle) + ring.b * std::sin(angle));
    }
}

}  // namespace

void Mesh::map(const std::function<Vec3(Vec3)>& to) {
    for (Vec3& position : positions) position = to(position);
}

void Mesh::bind(uint16_t joint) {
    joints.assign(positions.size(), {joint, 0, 0, 0});
    weights.assign(positions.size(), {1.0f, 0.0f, 0.0f, 0.0f});
}

void Mesh::bind_next(uint16_t first, uint16_t second, double share) {
    const auto weight = static_cast<float>(share);
    if (weight == 0.0f) second = 0;  // glTF wants the joints of zero weights to be 0.
    if (weight == 1.0f) first = 0;
    joints.push_back({first, second, 0, 0});
    weights.push_back({1.0f - weight, weight, 0.0f, 0.0f});
}

void Mesh::append(const Mesh& other) {
    const auto first = static_cast<uint32_t>(positions.size());
    append_to(positions, other.positions);
    append_to(normals, other.normals);
    append_to(uvs, other.uvs);
    append_to(colors, other.colors);
    append_to(joints, other.joints);
    append_to(weights, other.weights);
    for (const uint32_t index : other.indices) indices.push_back(first + index);
}

void Mesh::smooth_normals() {
    normals.assign(positions.size(), Vec3{});
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const Vec3 p = positions[indices[i]];
        const Vec3 area = cross(positions[indices[i + 1]] - p, positions[indices[i + 2]] - p);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Vec3& normal = normals[indices[i + corner]];
            normal = normal + area;
        }
    }
    for (Vec3& normal : normals) normal = normalized(normal);
}

Mesh sheet(uint32_t columns, uint32_t rows, const std::function<Vec3(double, double)>& point) {
    Mesh mesh;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns, v = static_cast<double>(row) / rows;
            mesh.positions.push_back(point(u, v));
            mesh.uvs.push_back({u, v});
        }
    }
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    }
    mesh.smooth_normals();
    return mesh;
}

Mesh box(Vec3 half_size, uint32_t divisions) {
    struct Face {
        Vec3 normal, du, dv;
    };
    static constexpr Face kFaces[] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
        {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
    };
    Mesh mesh;
    for (const Face& face : kFaces) {
        // All faces run along +X, +Y and +Z, so that faces that meet have the same bits on their common edge.
        Mesh grid = sheet(divisions, divisions, [&](double u, double v) {
            const Vec3 p = face.normal + face.du * (2.0 * u - 1.0) + face.dv * (2.0 * v - 1.0);
            return Vec3{p.x * half_size.x, p.y * half_size.y, p.z * half_size.z};
        });
        grid.normals.assign(grid.positions.size(), face.normal);
        grid.uvs.clear();
        mesh.append(grid);
    }
    return mesh;
}

uint32_t box_divisions(uint32_t triangles) {
    return std::max(1u, static_cast<uint32_t>(std::lround(std::sqrt(triangles / 12.0))));
}

Mesh tube(const Vec3& first_pole, std::span<const Ring> rings, const Vec3& last_pole, uint32_t sides) {
    assert(!rings.empty() && sides >= 3);
    Mesh mesh;
    mesh.positions.push_back(first_pole);
    for (const Ring& ring : rings) add_ring(mesh, ring, sides);
    mesh.positions.push_back(last_pole);

    const auto last = static_cast<uint32_t>(mesh.positions.size() - 1);
    const auto ring_count = static_cast<uint32_t>(rings.size());
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t j = (i + 1) % sides;
        mesh.indices.insert(mesh.indices.end(), {0, 1 + j, 1 + i});
        for (uint32_t r = 0; r + 1 < ring_count; ++r) {
            const uint32_t a = 1 + r * sides + i, b = 1 + r * sides + j;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + sides, a, b + sides, a + sides});
        }
        const uint32_t end = 1 + (ring_count - 1) * sides;
        mesh.indices.insert(mesh.indices.end(), {last, end + i, end + j});
    }
    mesh.smooth_normals();
    return mesh;
}

Mesh closed_loop(std::span<const Ring> rings, uint32_t sides) {
    assert(rings.size() >= 3 && sides >= 3);
    Mesh mesh;
    for (const Ring& ring : rings) add_ring(mesh, ring, sides);
    const auto ring_count = static_cast<uint32_t>(rings.size());
    for (uint32_t r = 0; r < ring_count; ++r) {
        const uint32_t from = r * sides, to = (r + 1) % ring_count * sides;
        for (uint32_t i = 0; i < sides; ++i) {
            const uint32_t j = (i + 1) % sides;
            mesh.indices.insert(mesh.indices.end(), {from + i, from + j, to + j, from + i, to + j, to + i});
        }
    }
    mesh.smooth_normals();
    return mesh;
}

Mesh lathe(std::span<const ProfilePoint> profile, uint32_t triangles) {
    assert(profile.size() >= 2);
    const auto distance = [&](std::size_t i) {  // To the next point.
        return std::hypot(profile[i + 1].radius - profile[i].radius, profile[i + 1].y - profile[i].y);
    };
    double reach = 0.0, area = 0.0;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        reach += distance(i);
        area += kPi * (profile[i].radius + profile[i + 1].radius) * distance(i);
    }
    // Quads are about square, but every point of the profile keeps its ring.
    const double step = reach / cut_for(triangles, reach * reach / area).rings;
    std::vector<Ring> rings;
    const auto add = [&](double radius, double y) { rings.push_back({{0.0, y, 0.0}, {0.0, 0.0, radius}, {radius, 0.0, 0.0}}); };
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const auto [radius, y] = profile[i];
        const auto cuts = std::max(1l, std::lround(distance(i) / step));
        for (long cut = 0; cut < cuts; ++cut) {
            const double share = static_cast<double>(cut) / static_cast<double>(cuts);
            add(radius + (profile[i + 1].radius - radius) * share, y + (profile[i + 1].y - y) * share);
        }
    }
    add(profile.back().radius, profile.back().y);
    const long sides = std::lround(triangles / 2.0 / static_cast<double>(rings.size()));
    return tube({0.0, profile.front().y, 0.0}, rings, {0.0, profile.back().y, 0.0}, static_cast<uint32_t>(std::max(5l, sides)));
}

Cut cut_for(uint32_t triangles, double aspect, uint32_t multiple) {
    const double around = std::sqrt(triangles / 2.0 / aspect);
    const auto steps = static_cast<uint32_t>(std::lround(around / multiple));
    Cut cut;
    cut.sides = std::max(multiple >= 3 ? multiple : 6u, steps * multiple);
    cut.rings = std::max(3u, static_cast<uint32_t>(std::lround(triangles / 2.0 / cut.sides)));
    return cut;
}

Mesh sphere(double radius, Cut cut) {
    std::vector<Ring> rings;
    for (uint32_t r = 1; r <= cut.rings; ++r) {
        const double angle = kPi * r / (cut.rings + 1);
        const double width = radius * std::sin(angle);
        rings.push_back({{0.0, -radius * std::cos(angle), 0.0}, {0.0, 0.0, width}, {width, 0.0, 0.0}});
    }
    Mesh mesh = tube({0.0, -radius, 0.0}, rings, {0.0, radius, 0.0}, cut.sides);
    mesh.normals = mesh.positions;
    for (Vec3& normal : mesh.normals) normal = normalized(normal);
    return mesh;
}

}  // namespace gnomon::makers
