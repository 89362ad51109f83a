// SPDX-License-Identifier: Apache-2.0
// The rays of a camera and the places of lights, in float.
#pragma once

#include <algorithm>
#include <gnomon/scene.hpp>
#include <vector>

#include "rays.hpp"

namespace gnomon::peer {

/// A shutter time as a segment between two keys and the local time in it, 0 to 1.
struct KeyTime {
    uint32_t segment;
    float s;
};

inline KeyTime key_time(float t, uint32_t segment_count) {
    const float keys = t * static_cast<float>(segment_count);
    const uint32_t segment = std::min(static_cast<uint32_t>(keys), segment_count - 1);
    return {segment, keys - static_cast<float>(segment)};
}

struct Placement {
    glm::vec3 translation;
    glm::mat3 rotation;  ///< World from local.
};

/// Between its keys: translation linear, rotation spherical by the shorter way.
class Motion {
public:
    /// keys: at least two.
    explicit Motion(const std::vector<Rigid>& keys);
    bool still() const { return still_; }
    Placement at(float t) const;

private:
    struct Segment {
        glm::vec3 from, step;
        glm::quat first, last;
        float angle, per_sine;  ///< Between the quaternions; 0: none.
    };
    std::vector<Segment> segments_;
    Placement first_;
    bool still_;
};

class View {
public:
    View(const Camera& camera, Motion motion, glm::uvec2 size_px);

    /// Set up the first rays.count rays, through points x, y in pixels at rays.time.
    void aim(const float* x, const float* y, Rays& rays) const;

private:
    Motion motion_;
    bool perspective_;
    glm::vec2 centre_px_, per_px_;
    float near_, far_;
};

}  // namespace gnomon::peer
