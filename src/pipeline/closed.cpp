// SPDX-License-Identifier: Apache-2.0
#include "pipeline/closed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

// What lies on one side of another along an axis: as ranges of its coordinate.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool apart(const Range& other, double margin) const { return low - other.high > margin || other.low - high > margin; }
};

// An axis of the view's space: at either key of a segment, its coordinate of a place in the world is normal * place + offset.
struct Axis {
    std::array<glm::dvec3, 2> normals;
    std::array<double, 2> offsets{};
    Range eye;

    // Of the hull of the box at both keys.
    Range of(const glm::dvec3& centre, const glm::dvec3& half) const {
        Range range;
        for (size_t i = 0; i < 2; ++i) {
            const double middle = glm::dot(normals[i], centre) + offsets[i], reach = glm::dot(glm::abs(normals[i]), half);
            range.add(middle - reach);
            range.add(middle + reach);
        }
        return range;
    }
};

}  // namespace

// Vertices move linearly between keys in the view's own space, where its rays do not move: what a box holds at both keys stays
// in the hull of its corners at both. Any axis that separates the hull from the eye will do; those tried are the space's, and
// the box's at either key.
struct Eye::Segment {
    std::array<Axis, 9> axes;
};

Eye::~Eye() = default;
Eye::Eye(Eye&&) noexcept = default;

Eye::Eye(const View& view) {
    const std::vector<glm::dvec3> corners = eye_corners(view);
    for (size_t k = 0; k + 1 < view.keys.size(); ++k) {
        if (k > 0 && view.keys[k - 1] == view.keys[k] && view.keys[k] == view.keys[k + 1]) continue;
        const std::array spaces = {Space(view, view.keys[k]), Space(view, view.keys[k + 1])};
        Segment& segment = segments_.emplace_back();
        for (size_t i = 0; i < segment.axes.size(); ++i) {
            glm::dvec3 unit(0.0);
            unit[static_cast<int>(i % 3)] = 1.0;
            const glm::dvec3 along = i < 3 ? unit : spaces[i / 3 - 1].direction(unit);
            Axis& axis = segment.axes[i];
            for (size_t s = 0; s < 2; ++s) {
                axis.normals[s] = along.x * spaces[s].x + along.y * spaces[s].y + along.z * spaces[s].z;
                axis.offsets[s] = glm::dot(along, spaces[s].shift) - glm::dot(axis.normals[s], spaces[s].origin);
            }
            for (const glm::dvec3& corner : corners) axis.eye.add(glm::dot(along, corner));
        }
    }
}

bool Eye::may_be_reached(const Bounds& box) const {
    const glm::dvec3 lower(box.lower), upper(box.upper);
    const glm::dvec3 centre = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
    const glm::dvec3 farthest = glm::max(glm::abs(lower), glm::abs(upper));
    const double in_world = std::max({farthest.x, farthest.y, farthest.z});
    return std::any_of(segments_.begin(), segments_.end(), [&](const Segment& segment) {
        double largest = in_world;
        std::array<Range, 3> own;  // Along the space's axes.
        for (size_t i = 0; i < own.size(); ++i) {
            own[i] = segment.axes[i].of(centre, half);
            largest = std::max({largest, std::abs(own[i].low), std::abs(own[i].high)});
        }
        const double margin = kMargin * largest;
        for (size_t i = 0; i < segment.axes.size(); ++i) {
            const Axis& axis = segment.axes[i];
            if (axis.eye.apart(i < own.size() ? own[i] : axis.of(centre, half), margin)) return false;
        }
        return true;
    });
}

std::vector<uint32_t> closed_shells(const Scene& scene, const std::vector<Pose>& poses, const GeometryBounds& bounds,
                                    const View& camera) {
    std::vector<Eye> eyes;
    eyes.emplace_back(camera);
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (scene.lights[i].kind != LightKind::directional)
            eyes.emplace_back(light_faces(scene.lights[i], poses, i, bounds.all, 1).front());
    }
    std::vector<uint32_t> closed;
    for (const Bounds& box : bounds.shells) {
        const bool reached = std::any_of(eyes.begin(), eyes.end(), [&](const Eye& eye) { return eye.may_be_reached(box); });
        closed.push_back(reached ? 0 : 1);
    }
    closed.push_back(0);
    return closed;
}

}  // namespace gnomon
