// SPDX-License-Identifier: Apache-2.0
// One prism, one texel, one cell of time: the range that comp_shaders/math/texel_range.h gives, and what it must contain.
#pragma once

#include <optional>
#include <string>

#include "math/texel_range.h"
#include "oracle/prism_kinds.hpp"

namespace gnomon::test {

struct ContainmentCase {
    oracle::PrismKind kind = oracle::PrismKind::random;
    bool orthographic = false;
    uint32_t size = 64;  ///< Texels of the image's sides.
    glm::uvec2 texel{0};
    uint32_t segments = 1;
    uint32_t segment = 0;  ///< That the prism is of.
    uint32_t cells = 1;
    uint32_t cell = 0;  ///< One of the segment's.
    oracle::Prism prism;

    oracle::Box box() const;     ///< The texel in raster space.
    double local_start() const;  ///< Of the cell, in the segment's local time.
    double local_end() const;
    double shutter(double local) const;  ///< The segment's local time in the shutter.
    std::string text() const;
};

/// A case of this kind with everything else drawn at random.
ContainmentCase make_case(oracle::PrismKind kind, std::mt19937& random);

/// As the raster stage finds it. Times in the shutter.
struct TexelRange {
    float enter = 0.0f;
    float leave = 0.0f;
    float nearest = 0.0f;
};

/// Empty: the triangle in this orientation has no range over the texel, or is not listed in it.
std::optional<TexelRange> range_of(const ContainmentCase& c, bool positive);

/// What a case showed.
struct Verdict {
    std::string error;        ///< What was not contained; empty: nothing.
    uint64_t stays = 0;       ///< Checked against the oracle of points.
    uint64_t overlaps = 0;    ///< Against the oracle of the whole texel.
    uint64_t float_hits = 0;  ///< Against the exact test in float.
    uint64_t excused = 0;     ///< Not contained, but of a triangle thinner than the rounding of its vertices.
};

/// Draw points of the texel and times of the cell, and compare.
Verdict check_containment(const ContainmentCase& c, std::mt19937& random);

/// The hull of the times, in the shutter, at which the triangle in this orientation overlaps the texel, from `steps` instants.
std::optional<glm::dvec2> true_range(const ContainmentCase& c, bool positive, int steps);

}  // namespace gnomon::test
