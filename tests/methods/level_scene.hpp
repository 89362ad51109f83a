// SPDX-License-Identifier: Apache-2.0
// Level rectangles that move evenly between keys, under a light and a camera that look straight down and may move as well: what
// both see is known in closed form.
#pragma once

#include <gnomon/render.hpp>
#include <vector>

#include "end_to_end/moving_triangles.hpp"
#include "views/view.hpp"

namespace gnomon::test {

struct LevelScene : MovingTriangles {
    struct Rectangle {
        glm::dvec2 half;               ///< Of its sides along x and z.
        std::vector<glm::dvec3> keys;  ///< Its centre.
    };
    /// What a point of a view sees.
    struct Seen {
        bool hit = false;
        glm::dvec3 point{0.0}, velocity{0.0};
    };

    /// Where the light and the camera are at each key.
    LevelScene(std::vector<glm::dvec3> light, std::vector<glm::dvec3> camera, LightKind kind, double camera_half_height)
        : MovingTriangles(static_cast<uint32_t>(light.size()) - 1),
          light_keys(std::move(light)),
          camera_keys(std::move(camera)),
          half_height(camera_half_height) {
        Light lamp;
        lamp.kind = kind;
        lamp.outer_cone = 0.7f;
        MovingTriangles::add(lamp, looking_down(light_keys));
        Camera eye;
        eye.kind = CameraKind::orthographic;
        eye.xmag = eye.ymag = half_height;
        MovingTriangles::add(eye, looking_down(camera_keys));
    }

    void add(const glm::dvec2& half, std::vector<glm::dvec3> keys) {
        keys.resize(poses.size(), keys.back());
        std::vector<glm::mat4> matrices(keys.size(), glm::mat4(1.0f));
        for (size_t k = 0; k < keys.size(); ++k) matrices[k][3] = glm::vec4(glm::vec3(keys[k]), 1.0f);
        const glm::vec3 x(static_cast<float>(half.x), 0.0f, 0.0f), z(0.0f, 0.0f, static_cast<float>(half.y));
        MovingTriangles::add({-x - z, -x + z, x + z}, matrices);
        MovingTriangles::add({-x - z, x + z, x - z}, matrices);
        rectangles.push_back({half, std::move(keys)});
    }

    glm::dvec3 at(const std::vector<glm::dvec3>& keys, double t) const {
        const size_t segment = segment_of(t);
        return glm::mix(keys[segment], keys[segment + 1], t * segments() - static_cast<double>(segment));
    }
    glm::dvec3 velocity(const std::vector<glm::dvec3>& keys, double t) const {
        const size_t segment = segment_of(t);
        return segments() * (keys[segment + 1] - keys[segment]);
    }

    /// Along a line that goes down from `from` (y: whence) by `slope` (x and z per metre).
    Seen look(const glm::dvec3& from, const glm::dvec2& slope, double t) const {
        Seen nearest;
        for (const Rectangle& r : rectangles) {
            const glm::dvec3 centre = at(r.keys, t);
            const double depth = from.y - centre.y;
            const glm::dvec3 p(from.x + slope.x * depth, centre.y, from.z + slope.y * depth);
            const bool inside = std::abs(p.x - centre.x) <= r.half.x && std::abs(p.z - centre.z) <= r.half.y;
            if (inside && depth > 0.0 && (!nearest.hit || p.y > nearest.point.y)) nearest = {true, p, velocity(r.keys, t)};
        }
        return nearest;
    }

    double segments() const { return static_cast<double>(poses.size() - 1); }
    size_t segment_of(double t) const { return std::min(static_cast<size_t>(t * segments()), poses.size() - 2); }

    static std::vector<Rigid> looking_down(const std::vector<glm::dvec3>& keys) {
        std::vector<Rigid> frames;
        for (const glm::dvec3& p : keys) frames.push_back({p, glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0))});
        return frames;
    }

    std::vector<glm::dvec3> light_keys, camera_keys;
    double half_height;
    std::vector<Rectangle> rectangles;
};

}  // namespace gnomon::test
