// SPDX-License-Identifier: Apache-2.0
// The oracle of moving triangles. A point of the image is the ray through (x, y, 1) of the space (x, y, w).
#include "oracle/moving_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/polynomial.hpp"

namespace gnomon::oracle {
namespace {

std::array<glm::dvec4, 3> vertices_at(const MovingTriangle& triangle, double s) {
    std::array<glm::dvec4, 3> vertices;
    for (size_t i = 0; i < 3; ++i) vertices[i] = triangle.start[i] + s * (triangle.end[i] - triangle.start[i]);
    return vertices;
}

glm::dvec3 without_depth(const glm::dvec4& p) { return {p.x, p.y, p.w}; }

// dot(a, cross(b, c)); zero where it is lost in the rounding of its terms.
double triple(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double kNoise = 0x1p-48;
    const glm::dvec3 sizes(std::abs(b.y * c.z) + std::abs(b.z * c.y), std::abs(b.z * c.x) + std::abs(b.x * c.z),
                           std::abs(b.x * c.y) + std::abs(b.y * c.x));
    const double value = glm::dot(a, glm::cross(b, c));
    return std::abs(value) > kNoise * glm::dot(glm::abs(a), sizes) ? value : 0.0;
}

// Positive for vertices that go clockwise as seen from the origin. Zero also where an edge is as short as its own rounding.
double volume_of(const std::array<glm::dvec4, 3>& v) {
    constexpr double kNoise = 0x1p-45;
    const glm::dvec3 p = without_depth(v[0]), to_1 = without_depth(v[1]) - p, to_2 = without_depth(v[2]) - p;
    const glm::dvec3 size = glm::max(glm::abs(p), glm::max(glm::abs(without_depth(v[1])), glm::abs(without_depth(v[2]))));
    const double value = triple(p, to_1, to_2);
    const glm::dvec3 area_noise = kNoise * (glm::length(to_1) + glm::length(to_2)) * size;
    return std::abs(value) > glm::dot(glm::abs(p), area_noise) ? value : 0.0;
}

// Keeps the side of the plane through the origin on which dot(normal, p) > 0.
std::vector<glm::dvec3> clip(const std::vector<glm::dvec3>& polygon, const glm::dvec3& normal) {
    std::vector<glm::dvec3> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double dp = glm::dot(normal, p), dq = glm::dot(normal, q);
        if (dp > 0.0) kept.push_back(p);
        if ((dp > 0.0) != (dq > 0.0)) kept.push_back(p + dp / (dp - dq) * (q - p));
    }
    return kept;
}

}  // namespace

// Moller and Trumbore 1997.
std::optional<Surface> surface_at(const MovingTriangle& triangle, double x, double y, double s) {
    const std::array<glm::dvec4, 3> v = vertices_at(triangle, s);
    const glm::dvec3 ray(x, y, 1.0), corner = without_depth(v[0]);
    const glm::dvec3 to_1 = without_depth(v[1]) - corner, to_2 = without_depth(v[2]) - corner;
    const glm::dvec3 p = glm::cross(ray, to_2), q = glm::cross(-corner, to_1);
    const double determinant = glm::dot(to_1, p), volume = volume_of(v);
    if (determinant == 0.0 || volume == 0.0) return std::nullopt;
    const double b1 = glm::dot(-corner, p) / determinant, b2 = glm::dot(ray, q) / determinant;
    const double w = glm::dot(to_2, q) / determinant;
    if (b1 < 0.0 || b2 < 0.0 || b1 + b2 > 1.0 || w <= 0.0) return std::nullopt;
    const double z = (1.0 - b1 - b2) * v[0].z + b1 * v[1].z + b2 * v[2].z;
    return Surface{z / w, volume > 0.0, {1.0 - b1 - b2, b1, b2}};
}

std::vector<Stay> stays_at(const MovingTriangle& triangle, double x, double y) {
    // A stay ends where the ray passes an edge, or where the triangle is seen edge-on.
    std::vector<Polynomial> px, py, pw;
    for (size_t i = 0; i < 3; ++i) {
        px.push_back(Polynomial::between(triangle.start[i].x, triangle.end[i].x));
        py.push_back(Polynomial::between(triangle.start[i].y, triangle.end[i].y));
        pw.push_back(Polynomial::between(triangle.start[i].w, triangle.end[i].w));
    }
    std::vector<long double> times = {0.0L, 1.0L};
    const auto add = [&](const Polynomial& p) {
        for (long double t : p.sign_changes()) times.push_back(t);
    };
    const Polynomial along_x({x}), along_y({y});
    Polynomial volume({0.0L});
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        add((px[i] - along_x * pw[i]) * (py[j] - along_y * pw[j]) - (px[j] - along_x * pw[j]) * (py[i] - along_y * pw[i]));
        volume = volume + pw[i] * (px[j] * py[k] - px[k] * py[j]);
    }
    add(volume);
    std::sort(times.begin(), times.end());

    std::vector<Stay> stays;
    for (size_t i = 0; i + 1 < times.size(); ++i) {
        const double enter = static_cast<double>(times[i]), leave = static_cast<double>(times[i + 1]);
        if (enter >= leave) continue;
        const std::optional<Surface> seen = surface_at(triangle, x, y, 0.5 * (enter + leave));
        if (!seen) continue;
        if (!stays.empty() && stays.back().leave == enter && stays.back().positive == seen->positive) {
            stays.back().leave = leave;
        } else {
            stays.push_back({enter, leave, seen->positive});
        }
    }
    return stays;
}

// Sutherland and Hodgman 1974, in homogeneous coordinates: of the pyramid over the box, its sides and its apex.
std::optional<bool> orientation_in(const MovingTriangle& triangle, const Box& box, double s) {
    const std::array<glm::dvec4, 3> v = vertices_at(triangle, s);
    std::vector<glm::dvec3> polygon;
    for (const glm::dvec4& p : v) polygon.push_back(without_depth(p));
    for (const glm::dvec3& normal :
         {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, -box.lower.x), glm::dvec3(-1.0, 0.0, box.upper.x),
          glm::dvec3(0.0, 1.0, -box.lower.y), glm::dvec3(0.0, -1.0, box.upper.y)}) {
        polygon = clip(polygon, normal);
    }
    if (polygon.size() < 3) return std::nullopt;
    const double volume = volume_of(v);
    if (volume == 0.0) return std::nullopt;
    return volume > 0.0;
}

std::vector<Seen> seen_at(const std::vector<MovingTriangle>& triangles, double x, double y, double s, double low, double high) {
    std::vector<Seen> all;
    for (size_t i = 0; i < triangles.size(); ++i) {
        const std::optional<Surface> surface = surface_at(triangles[i], x, y, s);
        if (surface && surface->depth > low && surface->depth < high) all.push_back({static_cast<uint32_t>(i), *surface});
    }
    std::stable_sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.surface.depth < b.surface.depth; });
    return all;
}

}  // namespace gnomon::oracle
