// SPDX-License-Identifier: Apache-2.0
// The oracle of triangulated prisms (Hong and Oh 2018, section 4.1): explicit triangles, cut by lines of sight, in double.
#pragma once

#include "oracle/moving_triangle.hpp"

namespace gnomon::oracle {

/// A corner of the surface: in raster space, with metres along the view's axis and time.
struct SurfaceCorner {
    glm::dvec4 at;
    double metres = 0.0;
    double time = 0.0;
};
using SurfaceTriangle = std::array<SurfaceCorner, 3>;

struct PrismSurface {
    std::vector<SurfaceTriangle> triangles;
    bool certain = true;  ///< No edge's crossing is within rounding of not being one.
};

PrismSurface triangulate(const MovingTriangle& triangle, bool orthographic);

struct Fragment {
    double metres = 0.0;
    double time = 0.0;
};

struct FragmentsAt {
    std::vector<Fragment> fragments;
    bool certain = true;  ///< The point is not within rounding of any triangle's edge.
};

/// Those in front of the eye.
FragmentsAt fragments_at(const PrismSurface& surface, double x, double y, bool orthographic);

}  // namespace gnomon::oracle
