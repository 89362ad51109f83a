// SPDX-License-Identifier: Apache-2.0
// Prisms to test with: random ones, and those that are hard.
#pragma once

#include <random>

#include "oracle/moving_triangle.hpp"

namespace gnomon::oracle {

enum class PrismKind {
    random,
    grazing,       ///< Nearly edge-on.
    degenerate,    ///< Without area at one key or at both.
    crossing_eye,  ///< Some vertices behind the eye at some time. Orthographic views have no eye: random.
    behind,        ///< All of it behind the eye. Orthographic: random.
    turning,       ///< Seen from one side first, then from the other.
    sub_texel,
    huge,  ///< 10^4 texels.
    motionless,
    fast,        ///< Up to 10^4 texels in a segment.
    on_borders,  ///< Vertices on corners of texels at both keys.
};
constexpr int kPrismKinds = 11;
const char* name_of(PrismKind kind);

/// Vertices in raster space at a segment's start and end, as the device holds them.
struct Prism {
    std::array<glm::vec4, 3> start, end;
};

/// A prism that most probably passes over the texel whose lower corner is given, raster space.
Prism make_prism(PrismKind kind, bool orthographic, const glm::dvec2& texel, std::mt19937& random);

/// The same in double.
MovingTriangle exact(const Prism& prism);

}  // namespace gnomon::oracle
