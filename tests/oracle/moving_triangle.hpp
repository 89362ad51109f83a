// SPDX-License-Identifier: Apache-2.0
// The oracle of moving triangles: where, when and how deep one is seen. Rays against planes and polygon clipping, in double.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace gnomon::oracle {

/// Vertices at local times 0 and 1 of a segment, linear in between, in a view's raster space: (x, y, z, w), where x / w and
/// y / w are texels from the image's centre, y down, z / w is the depth and what has w > 0 is seen.
struct MovingTriangle {
    std::array<glm::dvec4, 3> start, end;
};

/// An axis-aligned part of the image.
struct Box {
    glm::dvec2 lower, upper;
};

/// What is seen at a point. positive: the vertices go clockwise in the image (x right, y down).
struct Surface {
    double depth = 0.0;
    bool positive = false;
    glm::dvec3 barycentrics{0.0};  ///< Of the point on the triangle: weights of its vertices.
};

/// A time during which a triangle covers a point, local to its segment.
struct Stay {
    double enter = 0.0;
    double leave = 0.0;
    bool positive = false;
};

/// At the point (x, y) of the image and local time s. A triangle without area is never seen, nor is one whose area
/// is lost in the rounding of double.
std::optional<Surface> surface_at(const MovingTriangle& triangle, double x, double y, double s);

/// All stays over a point, ascending. Touches of zero length are left out.
std::vector<Stay> stays_at(const MovingTriangle& triangle, double x, double y);

/// Does it cover a part of the box's interior at local time s? Then: its orientation.
std::optional<bool> orientation_in(const MovingTriangle& triangle, const Box& box, double s);

/// One triangle seen in a sample.
struct Seen {
    uint32_t triangle = 0;
    Surface surface;
};

/// Everything seen at a point with low < depth < high, nearest first, equally near ones by their index.
std::vector<Seen> seen_at(const std::vector<MovingTriangle>& triangles, double x, double y, double s, double low, double high);

}  // namespace gnomon::oracle
