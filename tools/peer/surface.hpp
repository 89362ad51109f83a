// SPDX-License-Identifier: Apache-2.0
// What a hit reflects: diffuse surfaces under glTF lights, in float.
#pragma once

#include "view.hpp"

namespace gnomon::peer {

/// Three numbers of each of a batch.
struct Vectors {
    alignas(64) float x[kBatch], y[kBatch], z[kBatch];
    glm::vec3 at(uint32_t i) const { return {x[i], y[i], z[i]}; }
    void set(uint32_t i, const glm::vec3& v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
};

/// The hits of a batch of rays, in arrays so that loops over them become vector code.
struct Hits {
    uint32_t count = 0;
    Vectors point, normal;                   ///< normal: the triangle's, unit length, on the viewer's side.
    alignas(64) float u[kBatch], v[kBatch];  ///< Barycentrics of the second and third corner.
    float t[kBatch], depth[kBatch];
    uint32_t triangle[kBatch];
    uint32_t slot[kBatch];    ///< Of its pixel.
    uint32_t lit[kBatch];     ///< 1: the light that was asked last reaches it.
    uint32_t lights[kBatch];  ///< How many reach it of those that were asked.
};

class PeerLight {
public:
    PeerLight(const Light& light, Motion motion);

    bool directional() const { return kind_ == LightKind::directional; }
    bool still_sun() const { return directional() && motion_.still(); }

    /// From a hit to the light: unit length for a directional light, else all the way.
    glm::vec3 direction(const glm::vec3& point, float t) const;
    /// Is the direction inside a spot's outer cone? Not asked of directional lights.
    bool in_cone(const glm::vec3& to_light, float t) const;
    /// Add the light that arrives at each hit times the cosine, where `lit` says that nothing occludes it.
    void add_arriving(const Hits& hits, const Vectors& normals, Vectors& sums) const;

private:
    glm::vec3 arriving(const glm::vec3& point, float t, const glm::vec3& normal) const;

    LightKind kind_;
    glm::vec3 power_;
    float range_, cos_inner_, cos_outer_;
    Motion motion_;
};

/// What of a scene's surfaces does not move.
struct Paint {
    explicit Paint(const Scene& scene);

    std::vector<glm::vec3> colours;       ///< Of vertices; empty where all are white.
    std::vector<glm::vec3> base_colours;  ///< Of materials.
    bool textured = false;
    bool smooth = false;  ///< A vertex has a normal.
};

class Surface {
public:
    /// normals: of all vertices at each key, or empty. What it is made of must outlive this.
    Surface(const Scene& scene, const Paint& paint, const std::vector<std::vector<glm::vec3>>& normals)
        : scene_(scene), paint_(paint), normals_(normals) {}

    void get_normals(const Hits& hits, Vectors& normals) const;
    void get_albedos(const Hits& hits, Vectors& albedos) const;

private:
    const Scene& scene_;
    const Paint& paint_;
    const std::vector<std::vector<glm::vec3>>& normals_;
};

}  // namespace gnomon::peer
