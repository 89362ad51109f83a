// SPDX-License-Identifier: Apache-2.0
// Moving triangles given in raster space: what the stages get to see of them is exact to the bit.
#pragma once

#include <gnomon/scene.hpp>
#include <vector>

#include "oracle/prism_kinds.hpp"
#include "views/view.hpp"

namespace gnomon::test {

/// Triangles with their vertices at every key, and a view that projects them to just these places. World space is (x, y, w) for
/// a perspective view and (x, y, z) for an orthographic one.
struct Soup {
    uint32_t width = 64;
    uint32_t height = 64;
    bool orthographic = false;
    std::vector<std::vector<glm::vec4>> keys;  ///< [key][vertex]
    std::vector<glm::uvec3> triangles;

    Soup(uint32_t segments, uint32_t width_px, uint32_t height_px, bool is_orthographic);

    uint32_t segments() const { return static_cast<uint32_t>(keys.size()) - 1; }
    /// A vertex of its own at each key. Returns its index.
    uint32_t add_vertex(const std::vector<glm::vec4>& places);
    /// One that moves evenly from the first key to the last; in between it is rounded.
    void add_prism(const oracle::Prism& prism);
    /// `count` prisms, of all kinds in turn, over random texels of the image.
    void add_prisms(uint32_t count, std::mt19937& random);

    /// Every n-th triangle stands still.
    void hold_every(uint32_t n);

    /// As the oracles want it, rounded as the keys are.
    oracle::MovingTriangle triangle(uint32_t index, uint32_t segment) const;
    std::vector<oracle::MovingTriangle> all_triangles(uint32_t segment) const;

    Scene scene() const;
    std::vector<Pose> poses() const;
    View view() const;
};

}  // namespace gnomon::test
