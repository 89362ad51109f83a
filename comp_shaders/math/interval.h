// SPDX-License-Identifier: Apache-2.0
// When does a moving triangle cover a point of a view's image? All times, exactly but for rounding: roots of the three edge
// functions. Compare: Gribel et al. 2010, "Analytical motion blur rasterization with compression".
//
// With u in [0, 1] the time within a cell, an edge function at a point is (math/range.h)
//     e(u) = (1 - u)^2 start + u (1 - u) mixed + u^2 end
// In x = u / (1 - u) its roots are those of end x^2 + mixed x + start: with q = -(mixed + sign(mixed) sqrt(mixed^2 - 4 start
// end)) / 2 they are q / end and start / q, or
//     u = q / (q + end)  and  u = start / (start + q).
// Wherever one of them is asked for, both of its terms have the same sign: nothing cancels, no denominator vanishes, every root
// is in [0, 1], and edges that move linearly or not at all are no special cases. The negated function has the same roots, bit
// for bit, so triangles that share an edge hand over without gap or overlap.
#ifndef GNOMON_MATH_INTERVAL_H
#define GNOMON_MATH_INTERVAL_H
#include "texel_range.h"
#include "unit_size.h"
GN_BEGIN

// An edge function at a point during a cell of time.
struct EdgeQuadratic {
    float start;
    float mixed;
    float end;
};

// The edge p -> q, as seen from the point: (pa, qa) at the cell's start, (pb, qb) at its end.
GN_FN EdgeQuadratic edge_quadratic(vec2 pa, vec2 qa, vec2 pb, vec2 qb) {
    EdgeQuadratic e;
    e.start = edge_at_origin(pa, qa);
    float mixed = edge_at_origin(pa, qb) + edge_at_origin(pb, qa);
    e.mixed = mixed;
    e.end = edge_at_origin(pb, qb);
    return e;
}

GN_FN float edge_at(EdgeQuadratic e, float u) {
    float v = 1.0f - u;
    float value = v * v * e.start + u * v * e.mixed + u * u * e.end;
    return value;
}

// Times at which a quadratic is >= 0: from lo to hi (never, where lo > hi) but for the open gap from gap_lo to gap_hi (none,
// where gap_lo >= gap_hi).
struct EdgeTimes {
    float lo;
    float hi;
    float gap_lo;
    float gap_hi;
};

GN_FN EdgeTimes times_not_negative(EdgeQuadratic e) {
    float scale = unit_scale(max_of(abs(e.start), abs(e.mixed), abs(e.end)));
    float start = e.start * scale;
    float mixed = e.mixed * scale;
    float end = e.end * scale;
    float discriminant = mixed * mixed - 4.0f * start * end;
    float root = sqrt(max(discriminant, 0.0f));
    bool minus = mixed < 0.0f || (mixed == 0.0f && start < 0.0f);
    float q = -0.5f * (mixed + (minus ? -root : root));
    float divisor_start = start + q;
    float divisor_end = q + end;
    // What is divided by zero here is not used.
    float from_start = divisor_start != 0.0f ? start / divisor_start : 0.0f;
    float from_end = divisor_end != 0.0f ? q / divisor_end : 1.0f;

    bool starts = start >= 0.0f;
    bool ends = end >= 0.0f;
    bool crosses_twice = discriminant > 0.0f && (starts ? mixed < 0.0f : mixed > 0.0f);
    float crossing = (start < 0.0f) == (q < 0.0f) && divisor_start != 0.0f ? from_start : from_end;
    EdgeTimes times;
    times.lo = starts ? 0.0f : (ends ? crossing : (crosses_twice ? from_start : 1.0f));
    times.hi = ends ? 1.0f : (starts ? crossing : (crosses_twice ? from_end : 0.0f));
    bool gap = starts && ends && crosses_twice;
    times.gap_lo = gap ? from_start : 1.0f;
    times.gap_hi = gap ? from_end : 1.0f;
    return times;
}

// Up to four stays over a point: stay i lasts from enter[i] to leave[i], in order of time; there is none where enter[i] >=
// leave[i]. Touches without length are none.
struct Stays {
    vec4 enter;
    vec4 leave;
};

// The times at which all three edge functions are >= 0: of three intervals with one gap each.
GN_FN Stays common_times(EdgeTimes a, EdgeTimes b, EdgeTimes c) {
    float lo = max_of(a.lo, b.lo, c.lo);
    float hi = min_of(a.hi, b.hi, c.hi);
    // Gaps by their start.
    vec2 g0 = vec2(a.gap_lo, a.gap_hi), g1 = vec2(b.gap_lo, b.gap_hi), g2 = vec2(c.gap_lo, c.gap_hi);
    vec2 first = g1.x < g0.x ? g1 : g0, second = g1.x < g0.x ? g0 : g1;
    vec2 third = g2.x < second.x ? second : g2;
    second = g2.x < second.x ? g2 : second;
    vec2 earlier = second.x < first.x ? second : first;
    second = second.x < first.x ? first : second;
    first = earlier;
    Stays stays;
    stays.enter = vec4(lo, max(lo, first.y), max(max(lo, first.y), second.y), max(max(lo, first.y), max(second.y, third.y)));
    stays.leave = vec4(min(hi, first.x), min(hi, second.x), min(hi, third.x), hi);
    return stays;
}

// A triangle at a point: its edges, each opposite the vertex of its number.
struct PointPrism {
    EdgeQuadratic e0, e1, e2;
};

GN_FN PointPrism point_prism(CellTriangle c, float x, float y) {
    vec2 a0 = relative_to(c.a0, x, y), a1 = relative_to(c.a1, x, y), a2 = relative_to(c.a2, x, y);
    vec2 b0 = relative_to(c.b0, x, y), b1 = relative_to(c.b1, x, y), b2 = relative_to(c.b2, x, y);
    PointPrism p;
    p.e0 = edge_quadratic(a1, a2, b1, b2);
    p.e1 = edge_quadratic(a2, a0, b2, b0);
    p.e2 = edge_quadratic(a0, a1, b0, b1);
    return p;
}

// The stays of the triangle in this orientation. A triangle that is one point, whose edge functions are zero everywhere, has
// none.
GN_FN Stays stays_over(PointPrism p) {
    Stays stays = common_times(times_not_negative(p.e0), times_not_negative(p.e1), times_not_negative(p.e2));
    float size = abs(p.e0.start) + abs(p.e0.mixed) + abs(p.e0.end) + abs(p.e1.start) + abs(p.e1.mixed) + abs(p.e1.end) +
                 abs(p.e2.start) + abs(p.e2.mixed) + abs(p.e2.end);
    if (!(size > 0.0f)) stays.leave = vec4(-1.0f);
    return stays;
}

// Metres along the view's axis at time u of a stay. Barycentrics are kept from leaving the triangle by rounding, so the result
// is within the vertices' metres.
GN_FN float metres_at(PointPrism p, CellTriangle c, float u, bool orthographic) {
    float k0 = max(edge_at(p.e0, u), 0.0f), k1 = max(edge_at(p.e1, u), 0.0f), k2 = max(edge_at(p.e2, u), 0.0f);
    vec4 p0 = vertex_at(c.a0, c.b0 - c.a0, u), p1 = vertex_at(c.a1, c.b1 - c.a1, u), p2 = vertex_at(c.a2, c.b2 - c.a2, u);
    float m0 = orthographic ? p0.z : p0.w;
    float m1 = orthographic ? p1.z : p1.w;
    float m2 = orthographic ? p2.z : p2.w;
    float sum = k0 + k1 + k2;
    float blend = k0 * m0 + k1 * m1 + k2 * m2;
    // Where the triangle is seen edge-on at this instant any point of it will do.
    return sum > 0.0f ? blend / sum : (m0 + m1 + m2) * (1.0f / 3.0f);
}

GN_END
#endif
