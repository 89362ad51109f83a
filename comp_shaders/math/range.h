// SPDX-License-Identifier: Apache-2.0
// When can a moving triangle touch a texel? Conservative bounds of its three edge functions over a box of the image and over
// one cell of time.
//
// With u in [0, 1] the time within the cell, an edge function is the quadratic
//     e(u) = (1 - u)^2 E0 + u (1 - u) Ex + u^2 E1,    E0 = a_i x a_j,  E1 = b_i x b_j,  Ex = a_i x b_j + b_i x a_j
// whose coefficients are linear in the image point (a, b: the edge's vertices at the cell's start and end). Its distance from
// the chord is u (1 - u) (Ex - E0 - E1), so
//     e(u) <= (1 - u) E0 + u E1 + max(0, Ex - E0 - E1) / 4
// and over a box of half size h around a point each E grows by at most h (|A| + |B|), A and B its coefficients of X and Y:
// convex in u, hence below its own chord. So every edge has one linear upper bound: no roots, no cases, and for translating
// triangles, where Ex = E0 + E1, it is tight. The times at which all three bounds are
// >= 0 contain every time at which the triangle covers any point of the box.
// Compare: Laine and Karras 2011, "Efficient triangle coverage tests for stochastic rasterization"; Gribel et al. 2010
// (quadratic entry and exit).
#ifndef GNOMON_MATH_RANGE_H
#define GNOMON_MATH_RANGE_H
#include "cover.h"
GN_BEGIN

// A linear bound of one edge function over tile-relative points (X, Y): at the cell's start start.x X + start.y Y + start.z, at
// its end likewise. The box's half size, the curvature and the rounding are in the constant terms.
struct EdgeBound {
    vec3 start;
    vec3 end;
};

// Rounding, in units of 2^-24 (half an ulp of 1). Coordinates relative to the tile: a product of two of them carries at most 16
// roundings, among them those of its vertices' motion and of the exact test that is to be contained. Absolute coordinates
// (texels up to `extent`) were rounded before the subtraction, there and here: at most 16 roundings of `extent` texels, which
// shift the triangle and so act like a larger box. (They turn its edges too: of a triangle thinner than those roundings a part
// of a stay may be missed.)
const float kProductRounding = 16.0f / 16777216.0f;
const float kShiftRounding = 16.0f / 16777216.0f;

GN_FN vec3 cross3(vec3 a, vec3 b) { return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

GN_FN float max_of(float a, float b, float c) { return max(max(a, b), c); }
GN_FN float min_of(float a, float b, float c) { return min(min(a, b), c); }

// (x, y, w) relative to the point (cx, cy).
GN_FN vec3 tile_relative(vec4 p, float cx, float cy) { return vec3(p.x - cx * p.w, p.y - cy * p.w, p.w); }

// What all three edges of a prism share: the rounding of their products, and the box's half size with the rounding of absolute
// coordinates.
struct BoundScale {
    float rounding;  // Added to the bound.
    float half_size;
};

// For points within `reach` texels of the tile's centre and boxes of half size h; a, b: the vertices at the cell's ends,
// tile-relative; extent: the image's largest absolute coordinate, texels.
GN_FN BoundScale bound_scale(vec3 a0, vec3 a1, vec3 a2, vec3 b0, vec3 b1, vec3 b2, float reach, float h, float extent) {
    float mx = max(max_of(abs(a0.x), abs(a1.x), abs(a2.x)), max_of(abs(b0.x), abs(b1.x), abs(b2.x)));
    float my = max(max_of(abs(a0.y), abs(a1.y), abs(a2.y)), max_of(abs(b0.y), abs(b1.y), abs(b2.y)));
    float mw = max(max_of(abs(a0.z), abs(a1.z), abs(a2.z)), max_of(abs(b0.z), abs(b1.z), abs(b2.z)));
    float lowest_w = min(min_of(a0.z, a1.z, a2.z), min_of(b0.z, b1.z, b2.z));
    BoundScale s;
    s.rounding = kProductRounding * (mw * (mx + my) * reach + mx * my);
    float shift = kShiftRounding * extent;
    s.half_size = h + shift;
    // Behind the eye a shift of the vertices is no shift of the image: bound its effect on the products instead.
    s.rounding += lowest_w > 0.0f ? 0.0f : 2.0f * shift * mw * (mx + my + 2.0f * mw * reach);
    return s;
}

GN_FN EdgeBound edge_bound(vec3 ai, vec3 aj, vec3 bi, vec3 bj, BoundScale s, float reach) {
    vec3 e0 = cross3(ai, aj);
    vec3 e1 = cross3(bi, bj);
    vec3 cross_sum = cross3(ai, bj) + cross3(bi, aj);
    vec3 bend = cross_sum - e0 - e1;
    float bulge = 0.25f * max(0.0f, bend.z + reach * (abs(bend.x) + abs(bend.y)));
    float slack = bulge + s.rounding;
    EdgeBound bound;
    bound.start = vec3(e0.x, e0.y, e0.z + s.half_size * (abs(e0.x) + abs(e0.y)) + slack);
    bound.end = vec3(e1.x, e1.y, e1.z + s.half_size * (abs(e1.x) + abs(e1.y)) + slack);
    return bound;
}

// Shrink [lo, hi] to the times u at which the line from `start` (u = 0) to `end` (u = 1) is >= 0. `highest` becomes negative
// where it never is.
GN_FN void clip_to_bound(float start, float end, GN_INOUT(float) lo, GN_INOUT(float) hi, GN_INOUT(float) highest) {
    float rise = end - start;
    float root = -start / rise;
    lo = rise > 0.0f ? max(lo, root) : lo;
    hi = rise < 0.0f ? min(hi, root) : hi;
    highest = min(highest, max(start, end));
}

// Half the width by which times within a cell are widened: the rounding of t, of its product with the number of cells, and of
// the root.
GN_FN float time_slack(uint cell_count) { return (float(cell_count) + 8.0f) * (4.0f / 16777216.0f); }

GN_END
#endif
