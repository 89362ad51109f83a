// SPDX-License-Identifier: Apache-2.0
// What a hit reflects: diffuse surfaces under glTF lights, in float.
#pragma once

#include "view.hpp"

namespace gnomon::peer {

struct Hit {
    glm::vec3 point, normal;  ///< The triangle's, unit length, on the viewer's side.
    float u, v;               ///< Barycentrics of the second and third corner.
    float t, depth;
    uint32_t triangle, slot;  ///< slot: of its pixel.
    uint32_t lit;             ///< Bit i: light i reaches it.
};

class PeerLight {
public:
    PeerLight(const Light& light, Motion motion);

    bool directional() const { return kind_ == LightKind::directional; }
    bool shadows() const { return kind_ != LightKind::point; }  ///< Points are not traced, nor do they light.

    /// From a hit to the light: unit length for a directional light, all the way for a spot.
    glm::vec3 direction(const glm::vec3& point, float t) const;
    /// Spots: is the direction inside the outer cone?
    bool in_cone(const glm::vec3& to_light, float t) const;
    /// Light that arrives at the hit times the cosine, where nothing occludes it.
    glm::vec3 arriving(const Hit& hit, const glm::vec3& normal) const;

private:
    LightKind kind_;
    glm::vec3 power_;
    float range_, cos_inner_, cos_outer_;
    Motion motion_;
};

class Surface {
public:
    /// normals: of all vertices at each key, or empty. The scene and the normals must outlive this.
    Surface(const Scene& scene, const std::vector<std::vector<glm::vec3>>& normals, uint32_t segment_count);

    glm::vec3 albedo(const Hit& hit) const;
    glm::vec3 normal(const Hit& hit) const;

private:
    const Scene& scene_;
    const std::vector<std::vector<glm::vec3>>& normals_;
    uint32_t segment_count_;
};

}  // namespace gnomon::peer
