// SPDX-License-Identifier: Apache-2.0
// What a hit reflects: diffuse surfaces under glTF lights.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "motion.hpp"
#include "reference.hpp"

namespace gnomon::reference {

/// What a camera sample found.
struct Hit {
    uint32_t triangle = SampleRecord::kMiss;
    float t = 0.0f;            ///< In the shutter.
    KeyTime when;              ///< The same time.
    float u = 0.0f, v = 0.0f;  ///< Barycentrics of the second and third corner.
    double depth = 0.0;
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};  ///< Of the triangle at t, unit length, either side.
    glm::dvec3 to_eye{0.0};  ///< Any length.
};

/// A light and its motion.
class TracedLight {
public:
    TracedLight(const Light& light, RigidMotion motion);

    LightKind kind() const { return light_.kind; }

    /// From the hit to the light: unit length for a directional light, else all the way. None where no shadow is looked for:
    /// outside a spot's outer cone.
    std::optional<glm::dvec3> shadow_ray(const Hit& hit) const;

    /// Light that arrives at the hit where nothing occludes it, per unit of area facing the light (KHR_lights_punctual), and
    /// the unit direction that it comes from.
    struct Arriving {
        glm::dvec3 irradiance;
        glm::dvec3 direction;
    };
    Arriving arriving(const Hit& hit) const;

private:
    Light light_;
    RigidMotion motion_;
    double cos_inner_, cos_outer_;
};

class Shading {
public:
    /// The scene must outlive this.
    Shading(const Scene& scene, const std::vector<Pose>& poses);

    /// Sum over lights of albedo / pi * irradiance * cosine * visibility. The normal lies on the side of the triangle that the
    /// viewer sees. lit: of each light, whether it reaches the hit.
    glm::dvec3 reflected(const Hit& hit, const std::vector<TracedLight>& lights, std::span<const uint8_t> lit) const;

private:
    glm::dvec3 albedo(const Hit& hit) const;
    glm::dvec3 normal(const Hit& hit) const;

    const Scene& scene_;
    std::vector<std::vector<glm::vec3>> normals_;  ///< Of all vertices at each key; zero where the vertex has none.
};

}  // namespace gnomon::reference
