// SPDX-License-Identifier: Apache-2.0
// Triangle meshes of the scene makers: boxes, sheets and swept tubes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry.hpp"

namespace gnomon::makers {

using Rgba = std::array<uint8_t, 4>;  ///< Linear, 8 bits each.

/// Vertex attributes that are empty are not written. The others have one entry per vertex.
struct Mesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<std::array<double, 2>> uvs;
    std::vector<Rgba> colors;
    std::vector<std::array<uint16_t, 4>> joints;
    std::vector<std::array<float, 4>> weights;
    std::vector<uint32_t> indices;  ///< Three per triangle, counter-clockwise seen from outside.

    std::size_t triangle_count() const { return indices.size() / 3; }
    /// Move every vertex. Normals are left as they are.
    void map(const std::function<Vec3(Vec3)>& to);
    void paint(Rgba color) { colors.assign(positions.size(), color); }
    /// Bind every vertex to one joint.
    void bind(uint16_t joint);
    /// Bind the next vertex to two joints, the second with weight `share`, 0 to 1.
    void bind_next(uint16_t first, uint16_t second, double share);
    /// Add the vertices and triangles of `other`, which has the same attributes.
    void append(const Mesh& other);
    /// Vertex normals: the sum of the normals of the triangles around, weighted by area.
    void smooth_normals();
};

/// A closed box about the origin, each face a grid of divisions x divisions quads with its own vertices, flat normals: 12
/// divisions^2 triangles.
Mesh box(Vec3 half_size, uint32_t divisions);

/// The divisions of a box of about this many triangles.
uint32_t box_divisions(uint32_t triangles);

/// A grid of columns x rows quads. point(u, v), u and v in [0, 1], gives the positions; du x dv is the front. uv is (u, v).
Mesh sheet(uint32_t columns, uint32_t rows, const std::function<Vec3(double, double)>& point);

/// One cross-section of a tube: the ellipse center + a cos(angle) + b sin(angle). a x b points along the tube.
struct Ring {
    Vec3 center;
    Vec3 a;
    Vec3 b;
};

/// A closed tube through the rings, a pole at either end, smooth normals: 2 sides * rings.size() triangles. Vertex 0 is the
/// first pole, vertex 1 + r * sides + i point i of ring r, the last vertex the other pole.
Mesh tube(const Vec3& first_pole, std::span<const Ring> rings, const Vec3& last_pole, uint32_t sides);

/// A closed tube whose last ring is joined to its first: 2 sides * rings.size() triangles.
Mesh closed_loop(std::span<const Ring> rings, uint32_t sides);

/// A point of a profile that is turned about the Y axis.
struct ProfilePoint {
    double radius;
    double y;
};

/// A closed solid of revolution, about `triangles` triangles. The profile rises from one pole on the axis to the other; neither
/// is one of its points.
Mesh lathe(std::span<const ProfilePoint> profile, uint32_t triangles);

/// How finely a tube is cut.
struct Cut {
    uint32_t sides = 3;
    uint32_t rings = 1;
};

/// About `triangles` triangles with quads `aspect` times as many along the tube as around it; sides is a multiple of
/// `multiple`.
Cut cut_for(uint32_t triangles, double aspect, uint32_t multiple = 1);

/// A sphere about the origin with the poles on the Y axis.
Mesh sphere(double radius, Cut cut);

}  // namespace gnomon::makers
