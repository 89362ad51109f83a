// SPDX-License-Identifier: Apache-2.0
#include "pipeline/closed.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

// Of the largest coordinate: many times what rounding moves a vertex in a view.
constexpr double kMargin = 1.0 / 65536.0;

// A view's space at one key, without its scale: x and y across the image, z along the view axis; metres.
struct Space {
    glm::dvec3 origin, x, y, z;
    glm::dvec3 shift{0.0};

    Space(const View& view, const ViewKey& key) : origin(key.origin) {
        const glm::vec4& depth = view.orthographic ? key.row_z : key.row_w;
        x = glm::dvec3(glm::vec3(key.row_x)) / double{view.scale_x};
        y = glm::dvec3(glm::vec3(key.row_y)) / double{view.scale_y};
        z = glm::dvec3(glm::vec3(depth));
        shift = {key.row_x.w / double{view.scale_x}, key.row_y.w / double{view.scale_y}, depth.w};
    }
    glm::dvec3 point(const glm::dvec3& p) const { return direction(p - origin) + shift; }
    glm::dvec3 direction(const glm::dvec3& d) const { return {glm::dot(x, d), glm::dot(y, d), glm::dot(z, d)}; }
};

// The corners of the space in which rays start.
std::vector<glm::dvec3> eye_corners(const View& view) {
    const double near = view.orthographic ? view.depth_near : -1.0 / view.depth_near;
    const double spread = view.orthographic ? 1.0 : near;
    const double x = 0.5 * view.width / view.scale_x * spread, y = 0.5 * view.height / view.scale_y * spread;
    std::vector<glm::dvec3> corners = {{-x, -y, near}, {x, -y, near}, {-x, y, near}, {x, y, near}};
    if (!view.orthographic) corners.emplace_back(0.0);
    // One of a light's faces stands for all of them: their near planes are the sides of a cube.
    if (view.face != shared::kOnlyFace)
        corners.insert(corners.end(), {{-x, -y, -near}, {x, -y, -near}, {-x, y, -near}, {x, y, -near}});
    return corners;
}

bool separates(const glm::dvec3& axis, const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, double margin) {
    const auto along = [&](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(axis, p) < glm::dot(axis, q); };
    const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end(), along);
    const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end(), along);
    return glm::dot(axis, *a_low - *b_high) > margin || glm::dot(axis, *b_low - *a_high) > margin;
}

}  // namespace

// Vertices move linearly between keys in the view's own space, where its rays do not move: what a box holds at both keys stays
// in the hull of its corners at both. Any axis that separates the hull from the eye will do; those tried are the space's, and
// the box's at either key.
bool may_reach_eye(const Bounds& box, const View& view) {
    const std::vector<glm::dvec3> eye = eye_corners(view);
    std::vector<Space> spaces;
    for (const ViewKey& key : view.keys) spaces.emplace_back(view, key);
    for (size_t k = 0; k + 1 < spaces.size(); ++k) {
        std::vector<glm::dvec3> hull;
        std::vector<glm::dvec3> axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (const Space& space : {spaces[k], spaces[k + 1]}) {
            for (int corner = 0; corner < 8; ++corner) {
                hull.push_back(space.point({corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                                            corner & 4 ? box.upper.z : box.lower.z}));
            }
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 e(0.0);
                e[axis] = 1.0;
                axes.push_back(space.direction(e));
            }
        }
        double largest = std::max({std::abs(box.lower.x), std::abs(box.lower.y), std::abs(box.lower.z), std::abs(box.upper.x),
                                   std::abs(box.upper.y), std::abs(box.upper.z)});
        for (const glm::dvec3& p : hull) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        const auto apart = [&](const glm::dvec3& axis) { return separates(axis, hull, eye, kMargin * largest); };
        if (std::none_of(axes.begin(), axes.end(), apart)) return true;
    }
    return false;
}

std::vector<uint32_t> closed_shells(const Scene& scene, const std::vector<Pose>& poses, const GeometryBounds& bounds,
                                    const View& camera) {
    std::vector<View> views = {camera};
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (scene.lights[i].kind != LightKind::directional)
            views.push_back(light_faces(scene.lights[i], poses, i, bounds.all, 1).front());
    }
    std::vector<uint32_t> closed;
    for (const Bounds& box : bounds.shells) {
        const bool reached =
            std::any_of(views.begin(), views.end(), [&](const View& view) { return may_reach_eye(box, view); });
        closed.push_back(reached ? 0 : 1);
    }
    closed.push_back(0);
    return closed;
}

}  // namespace gnomon
