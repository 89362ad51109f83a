// SPDX-License-Identifier: Apache-2.0
// Shapes and viewpoints for scenes that are built without a file. Normals point outward.
#pragma once

#include <cmath>
#include <numbers>

#include "moving_triangles.hpp"
#include "test_scenes.hpp"

namespace gnomon::test {

/// A quadrangle as two triangles, with texture coordinates (0, 0), (1, 0), (1, 1), (0, 1).
inline void add_face(MovingTriangles& scene, const std::array<glm::vec3, 4>& corners, glm::vec3 motion = glm::vec3(0.0f)) {
    const size_t first = scene.scene.vertices.size();
    scene.add({corners[0], corners[1], corners[2]}, motion);
    scene.add({corners[0], corners[2], corners[3]}, motion);
    const glm::vec2 uvs[] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (size_t i = 0; i < 6; ++i) scene.scene.vertices[first + i].uv = uvs[i];
}

/// The parallelogram a, a + u, a + u + v, a + v.
inline void add_quad(MovingTriangles& scene, glm::vec3 a, glm::vec3 u, glm::vec3 v, glm::vec3 motion = glm::vec3(0.0f)) {
    add_face(scene, {a, a + u, a + u + v, a + v}, motion);
}

/// The square |x|, |z| <= half_size at height y.
inline void add_floor(MovingTriangles& scene, float y, float half_size, glm::vec3 motion = glm::vec3(0.0f)) {
    add_quad(scene, {-half_size, y, half_size}, {2 * half_size, 0, 0}, {0, 0, -2 * half_size}, motion);
}

/// Closed: its faces have the same corners to the bit.
inline void add_box(MovingTriangles& scene, glm::vec3 centre, glm::vec3 half, glm::vec3 motion = glm::vec3(0.0f)) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto corner = [&](float u, float v) {
                glm::vec3 p = centre;
                p[axis] += side * half[axis];
                p[(axis + 1) % 3] += u * half[(axis + 1) % 3];
                p[(axis + 2) % 3] += v * half[(axis + 2) % 3];
                return p;
            };
            const float w = side;  // Of two sides one is gone round the other way.
            add_face(scene, {corner(-1, -1), corner(w, -w), corner(1, 1), corner(-w, w)}, motion);
        }
    }
}

/// A closed, convex mesh of 4 rings^2 - 4 rings triangles on the sphere.
inline void add_sphere(MovingTriangles& scene, glm::vec3 centre, float radius, int rings, glm::vec3 motion = glm::vec3(0.0f)) {
    const auto point = [&](int i, int j) {
        const double polar = std::numbers::pi * i / rings, around = std::numbers::pi * (j % (2 * rings)) / rings;
        if (i == 0 || i == rings) return centre + glm::vec3(0.0f, i == 0 ? radius : -radius, 0.0f);
        return centre +
               radius * glm::vec3(std::sin(polar) * std::cos(around), std::cos(polar), -std::sin(polar) * std::sin(around));
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < 2 * rings; ++j) {
            if (i > 0) scene.add({point(i, j), point(i + 1, j), point(i, j + 1)}, motion);
            if (i + 1 < rings) scene.add({point(i, j + 1), point(i + 1, j), point(i + 1, j + 1)}, motion);
        }
    }
}

inline Camera perspective(double yfov) {
    Camera camera;
    camera.yfov = yfov;
    return camera;
}

inline Camera orthographic(double half_height) {
    Camera camera;
    camera.kind = CameraKind::orthographic;
    camera.ymag = half_height;
    return camera;
}

/// Cones: half angles in radians.
inline Light spot(float outer, float inner = 0.0f, float intensity = 1.0f) {
    Light light;
    light.kind = LightKind::spot;
    light.outer_cone = outer;
    light.inner_cone = inner;
    light.intensity = intensity;
    return light;
}

inline Light sun(float intensity = 1.0f) {
    Light light;
    light.intensity = intensity;
    return light;
}

/// At `eye`, looking at `target`.
inline Rigid at(const glm::dvec3& eye, const glm::dvec3& target) { return {eye, looking(target - eye)}; }

inline RenderSettings small_settings(uint32_t width, uint32_t height, uint32_t spp, uint32_t shadow_res = 256) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.spp = spp;
    settings.shadow_res = shadow_res;
    return settings;
}

/// A floor, two boxes and a sphere, moving; a camera; a sun.
inline MovingTriangles still_life(uint32_t segments) {
    MovingTriangles scene(segments);
    add_floor(scene, 0.0f, 6.0f);
    add_box(scene, {-1.0f, 0.8f, 0.0f}, {0.4f, 0.4f, 0.4f}, {0.7f, 0.3f, 0.2f});
    add_box(scene, {1.1f, 1.6f, -0.5f}, {0.5f, 0.1f, 0.7f}, {-0.4f, 0.9f, 0.5f});
    add_sphere(scene, {0.3f, 1.0f, 0.9f}, 0.5f, 8, {0.5f, -0.4f, -0.3f});
    scene.add(perspective(0.7), {at({2.0, 3.5, 5.0}, {0.0, 0.6, 0.0})});
    scene.add(sun(3.0f), {{glm::dvec3(0.0), looking({-0.5, -1.0, -0.3})}});
    return scene;
}

}  // namespace gnomon::test
