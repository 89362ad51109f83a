// SPDX-License-Identifier: Apache-2.0
#include "oracle/prism_surface.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::oracle {
namespace {

constexpr double kRounding = 1e-4;

glm::dvec2 project(const SurfaceCorner& c) { return glm::dvec2(c.at) / c.at.w; }

SurfaceCorner mean(const std::vector<SurfaceCorner>& corners) {
    SurfaceCorner sum{glm::dvec4(0.0)};
    for (const SurfaceCorner& c : corners) {
        sum.at += c.at;
        sum.metres += c.metres;
        sum.time += c.time;
    }
    const auto n = static_cast<double>(corners.size());
    return {sum.at / n, sum.metres / n, sum.time / n};
}

/// The point of the edge a b, in space, that projects to the share s of its image.
SurfaceCorner on_edge(const SurfaceCorner& a, const SurfaceCorner& b, double s) {
    // (1 - u) a + u b projects there: its distance along the image is u wb / ((1 - u) wa + u wb).
    const double u = s / (s + (1.0 - s) * b.at.w / a.at.w);
    return {a.at + u * (b.at - a.at), a.metres + u * (b.metres - a.metres), a.time};
}

}  // namespace

PrismSurface triangulate(const MovingTriangle& triangle, bool orthographic) {
    PrismSurface surface;
    SurfaceTriangle start, end;
    for (size_t i = 0; i < 3; ++i) {
        start[i] = {triangle.start[i], orthographic ? triangle.start[i].z : triangle.start[i].w, 0.0};
        end[i] = {triangle.end[i], orthographic ? triangle.end[i].z : triangle.end[i].w, 1.0};
    }
    surface.triangles = {start, end};
    for (size_t i = 0; i < 3; ++i) {
        const SurfaceCorner &a = start[i], &b = start[(i + 1) % 3], &c = end[i], &d = end[(i + 1) % 3];
        if (std::min({a.at.w, b.at.w, c.at.w, d.at.w}) > 0.0) {
            // a + s (b - a) = c + u (d - c), by Cramer's rule.
            const glm::dmat2 m(project(b) - project(a), project(c) - project(d));
            const double det = glm::determinant(m), size = glm::length(m[0]) * glm::length(m[1]);
            if (det != 0.0) {
                const glm::dvec2 su = glm::inverse(m) * (project(c) - project(a));
                const auto inside = [](double v, double widen) { return v >= -widen && v <= 1.0 + widen; };
                if (inside(su.x, kRounding) && inside(su.y, kRounding) &&
                    !(inside(su.x, -kRounding) && inside(su.y, -kRounding)))
                    surface.certain = false;
                if (std::fabs(det) < kRounding * size) surface.certain = false;
                if (inside(su.x, 0.0) && inside(su.y, 0.0)) {
                    SurfaceCorner p = on_edge(a, b, su.x), q = on_edge(c, d, su.y);
                    const SurfaceCorner crossing = mean({p, q});
                    surface.triangles.push_back({a, crossing, c});
                    surface.triangles.push_back({b, crossing, d});
                    continue;
                }
            }
        }
        const SurfaceCorner centre = mean({a, b, c, d});
        for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, d}, std::pair{d, c}, std::pair{c, a}})
            surface.triangles.push_back({p, q, centre});
    }
    return surface;
}

FragmentsAt fragments_at(const PrismSurface& surface, double x, double y, bool orthographic) {
    FragmentsAt result;
    for (const SurfaceTriangle& t : surface.triangles) {
        // Weights for which the corners' mean lies on the line of sight.
        glm::dmat3 corners;
        double size = 1.0;
        for (glm::length_t i = 0; i < 3; ++i) {
            const glm::dvec4& p = t[static_cast<size_t>(i)].at;
            corners[i] = glm::dvec3(p.x - x * p.w, p.y - y * p.w, p.w);
            size *= glm::length(corners[i]);
        }
        const double det = glm::determinant(corners);
        if (std::fabs(det) < 1e-9 * size) {
            // Seen edge-on, or without area: none, if the point is not on it.
            const double reach = std::max({glm::length(glm::dvec2(corners[0])), glm::length(glm::dvec2(corners[1])),
                                           glm::length(glm::dvec2(corners[2]))});
            if (reach < 1e3) result.certain = false;
            continue;
        }
        glm::dvec3 weights = glm::inverse(corners) * glm::dvec3(0.0, 0.0, 1.0);
        weights /= weights.x + weights.y + weights.z;
        const double least = std::min({weights.x, weights.y, weights.z});
        if (std::fabs(least) < kRounding) result.certain = false;
        if (least < 0.0) continue;
        Fragment f;
        for (glm::length_t i = 0; i < 3; ++i) {
            f.metres += weights[i] * t[static_cast<size_t>(i)].metres;
            f.time += weights[i] * t[static_cast<size_t>(i)].time;
        }
        if (orthographic || f.metres > 0.0) result.fragments.push_back(f);
        if (!orthographic && std::fabs(f.metres) < kRounding) result.certain = false;
    }
    return result;
}

}  // namespace gnomon::oracle
