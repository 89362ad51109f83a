// SPDX-License-Identifier: Apache-2.0
// Bounds, and what is added to a scene that lacks it: a camera, a light, a ground.
#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <limits>
#include <numbers>

#include "scene/rig.hpp"

namespace gnomon {

namespace {

// The scene's rig is shared and constant: change a copy.
template <typename F>
void change_rig(Scene& scene, const F& change) {
    const auto rig = std::make_shared<Rig>(*scene.rig);
    change(*rig);
    scene.rig = rig;
}

// The rotation that looks along `forward` with +Y up. `forward` is a unit vector and not vertical.
glm::dquat look_along(glm::dvec3 forward) {
    const glm::dvec3 x = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(x, forward), -forward)));
}

std::string fixed3(double x) {
    std::string text = std::to_string(x);
    return text.substr(0, text.size() - 3);
}

}  // namespace

Bounds bounds_of(const Scene& scene, const std::vector<Pose>& poses) {
    const auto fail = [&](const std::string& what, const std::string& hint) {
        return Error(ErrorKind::input, what, "in " + scene.path.string(), hint);
    };
    if (scene.triangles.empty()) throw fail("the scene has no triangles", "choose a scene with a mesh of triangles");
    Bounds bounds{glm::vec3(std::numeric_limits<float>::infinity()), glm::vec3(-std::numeric_limits<float>::infinity())};
    for (const Pose& pose : poses) {
        const std::vector<glm::vec3> positions = posed_positions(scene, pose);
        for (const Triangle& triangle : scene.triangles) {
            for (const uint32_t vertex : triangle.vertex) {
                const glm::vec3 p = positions[vertex];
                if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                    throw fail("the position of vertex " + std::to_string(vertex) + " at " + std::to_string(pose.seconds) +
                                   " s is not finite",
                               "repair the mesh or its animation");
                }
                bounds.lower = glm::min(bounds.lower, p);
                bounds.upper = glm::max(bounds.upper, p);
            }
        }
    }
    return bounds;
}

void add_default_camera(Scene& scene, std::vector<Pose>& poses, const Bounds& bounds, double aspect) {
    constexpr double kYFov = 40.0 * std::numbers::pi / 180.0;
    constexpr double kFilled = 0.9;  // Share of the image's half sides that the box may reach.
    const glm::dvec3 forward = glm::normalize(glm::dvec3(-0.6, -0.35, -1.0));
    const glm::dquat rotation = look_along(forward);
    const glm::dvec3 lower(bounds.lower);
    const glm::dvec3 upper(bounds.upper);
    const glm::dvec3 center = 0.5 * (lower + upper);
    // A box that is a point is framed like one of side 1.
    const double radius = upper == lower ? 0.5 : 0.5 * glm::length(upper - lower);

    // The least distance from the centre at which every corner projects inside the filled part.
    const double tan_y = kFilled * std::tan(0.5 * kYFov);
    const double tan_x = tan_y * aspect;
    double distance = radius;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? upper.x : lower.x, (corner & 2) != 0 ? upper.y : lower.y,
                           (corner & 4) != 0 ? upper.z : lower.z);
        const glm::dvec3 q = glm::conjugate(rotation) * (p - center);
        distance = std::max({distance, std::abs(q.x) / tan_x + q.z, std::abs(q.y) / tan_y + q.z});
    }
    distance = std::max(distance, 1.01 * radius);

    Camera camera;
    camera.name = "default";
    camera.yfov = kYFov;
    camera.znear = std::max(0.5 * (distance - radius), 1e-3 * distance);
    camera.zfar = 100.0 * (distance + radius);
    const Rigid place{center - distance * forward, rotation};
    scene.cameras.push_back(camera);
    for (Pose& pose : poses) pose.cameras.push_back(place);
    change_rig(scene, [&](Rig& rig) { rig.cameras.push_back({Rig::kNoNode, place}); });
    scene.warnings.emplace_back("the scene has no camera: one that frames it was added at (" + fixed3(place.translation.x) +
                                ", " + fixed3(place.translation.y) + ", " + fixed3(place.translation.z) + ")");
}

void add_default_light(Scene& scene, std::vector<Pose>& poses) {
    Light light;
    light.name = "default";
    light.kind = LightKind::directional;
    light.intensity = std::numbers::pi_v<float>;  // A white surface that faces it has radiance 1: albedo / pi * intensity.
    const Rigid place{glm::dvec3(0.0), look_along(glm::normalize(glm::dvec3(0.5, -1.0, -0.7)))};
    scene.lights.push_back(light);
    for (Pose& pose : poses) pose.lights.push_back(place);
    change_rig(scene, [&](Rig& rig) { rig.lights.push_back({Rig::kNoNode, place}); });
    scene.warnings.emplace_back("the scene has no light: a directional light from the upper left was added");
}

void add_ground(Scene& scene, std::vector<Pose>& poses, glm::vec2 center_xz, float y, float half_size) {
    Material material;
    material.name = "ground";
    material.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    const auto material_index = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);

    const auto matrix = static_cast<uint32_t>(scene.rig->palette.size());
    change_rig(scene, [](Rig& rig) { rig.palette.push_back({}); });
    for (Pose& pose : poses) {
        pose.palette.insert(pose.palette.end(), {glm::vec4(1.0f, 0.0f, 0.0f, 0.0f), glm::vec4(0.0f, 1.0f, 0.0f, 0.0f),
                                                 glm::vec4(0.0f, 0.0f, 1.0f, 0.0f)});
    }

    const auto first = static_cast<uint32_t>(scene.vertices.size());
    constexpr glm::vec2 kCorners[] = {{-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}, {-1.0f, -1.0f}};  // Facing up.
    for (const glm::vec2 corner : kCorners) {
        Vertex vertex;
        vertex.position = {center_xz.x + half_size * corner.x, y, center_xz.y + half_size * corner.y};
        vertex.normal = {0.0f, 1.0f, 0.0f};
        vertex.uv = 0.5f * corner + 0.5f;
        vertex.influence_first = static_cast<uint32_t>(scene.influences.size());
        vertex.influence_count = 1;
        scene.influences.push_back({matrix, 1.0f});
        scene.vertices.push_back(vertex);
    }
    scene.triangles.push_back({{first, first + 1, first + 2}, material_index});
    scene.triangles.push_back({{first, first + 2, first + 3}, material_index});
}

}  // namespace gnomon
