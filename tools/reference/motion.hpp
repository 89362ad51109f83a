// SPDX-License-Identifier: Apache-2.0
// Where things are at a shutter time, in double: rigid cameras and lights, and the corners of triangles.
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/scene.hpp>
#include <vector>

namespace gnomon::reference {

/// A shutter time as a segment between two keys and the local time in it, 0 to 1.
struct KeyTime {
    uint32_t segment = 0;
    double s = 0.0;
};

/// t: in the shutter, 0 to 1.
inline KeyTime key_time(double t, uint32_t segment_count) {
    const double keys = t * segment_count;
    const uint32_t segment = std::min(static_cast<uint32_t>(keys), segment_count - 1);
    return {segment, keys - segment};
}

/// A camera or a light between its keys: translation linear, rotation spherical by the shorter way.
class RigidMotion {
public:
    struct Placement {
        glm::dvec3 translation;
        glm::dmat3 rotation;  ///< World from local: columns are the local axes.
    };

    /// keys: at least two.
    explicit RigidMotion(const std::vector<Rigid>& keys);
    Placement at(KeyTime when) const;

private:
    struct Segment {
        glm::dvec3 from, step;
        glm::dquat first, last;
        glm::dmat3 first_rotation;
        double angle;  ///< Between the quaternions, 0 to pi/2.
    };
    std::vector<Segment> segments_;
};

/// Of all vertices in one pose, of any length; zero where a vertex has none.
std::vector<glm::vec3> posed_normals(const Scene& scene, const Pose& pose);

/// All triangles between their keys: world positions linear.
class SurfaceMotion {
public:
    /// Poses each key in a thread of its own. The scene must outlive this.
    SurfaceMotion(const Scene& scene, const std::vector<Pose>& poses);

    uint32_t segment_count() const { return static_cast<uint32_t>(keys_.size()) - 1; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

    /// World positions at key k, followed by one element of padding, so that the last one can be read as 16 bytes.
    const std::vector<glm::vec3>& key(uint32_t k) const { return keys_[k]; }

    std::array<glm::dvec3, 3> corners(uint32_t triangle, KeyTime when) const;

private:
    const std::vector<Triangle>& triangles_;
    std::vector<std::vector<glm::vec3>> keys_;
};

}  // namespace gnomon::reference
