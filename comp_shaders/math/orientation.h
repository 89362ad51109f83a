// SPDX-License-Identifier: Apache-2.0
// Which way round a moving triangle is seen during a cell of time: the sign of its determinant, a cubic in time, bounded by its
// Bernstein coefficients.
#ifndef GNOMON_MATH_ORIENTATION_H
#define GNOMON_MATH_ORIENTATION_H
#include "range.h"
GN_BEGIN

const uint kSeenPositive = 1u;  // May have det > 0 at some time.
const uint kSeenNegative = 2u;
// How the eye sees a triangle that looks away from it, when its vertices run counterclockwise around its outer side, as in
// glTF: y is down in raster space.
const uint kSeenAway = kSeenPositive;
const uint kSeenFacing = kSeenNegative;
const uint kSeenAny = kSeenPositive | kSeenNegative;

GN_FN float det3(vec3 a, vec3 b, vec3 c) {
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

// Vertices (x, y, w) relative to any fixed image point near the triangle, at the cell's start (a) and end (b).
GN_FN uint orientations(vec3 a0, vec3 a1, vec3 a2, vec3 b0, vec3 b1, vec3 b2, float extent) {
    float c0 = det3(a0, a1, a2);
    float c1 = (det3(b0, a1, a2) + det3(a0, b1, a2) + det3(a0, a1, b2)) * (1.0f / 3.0f);
    float c2 = (det3(a0, b1, b2) + det3(b0, a1, b2) + det3(b0, b1, a2)) * (1.0f / 3.0f);
    float c3 = det3(b0, b1, b2);
    float lowest = min(min(c0, c1), min(c2, c3));
    float highest = max(max(c0, c1), max(c2, c3));
    float mx = max(max_of(abs(a0.x), abs(a1.x), abs(a2.x)), max_of(abs(b0.x), abs(b1.x), abs(b2.x)));
    float my = max(max_of(abs(a0.y), abs(a1.y), abs(a2.y)), max_of(abs(b0.y), abs(b1.y), abs(b2.y)));
    float mw = max(max_of(abs(a0.z), abs(a1.z), abs(a2.z)), max_of(abs(b0.z), abs(b1.z), abs(b2.z)));
    // Six products each with at most 16 roundings, and coordinates that were rounded at the size of `extent` texels.
    float error = 6.0f * kProductRounding * mx * my * mw + 4.0f * kShiftRounding * extent * mw * mw * (mx + my);
    return (highest >= -error ? kSeenPositive : 0u) | (lowest <= error ? kSeenNegative : 0u);
}

GN_END
#endif
