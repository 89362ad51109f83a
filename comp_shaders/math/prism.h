// SPDX-License-Identifier: Apache-2.0
// The surface of a prism, triangulated, and the fragments that it leaves at a point of the image.
// Based on: Hong and Oh 2018, "Motion-blurred shadows utilizing a depth-time ranges shadow map", section 4.1.
//
// The surface: the triangle at the cell's start (time 0) and at its end (time 1), and a side for each of its edges. A side
// whose edge crosses itself in the image, start against end (eq. 1), is two triangles that meet in the crossing, else four
// around the mean of its corners; both these points have time 1/2. What the paper leaves open: the crossing's depth is the mean
// of its depths on both edges; a side with a corner behind the eye is always four triangles; time and depth are linear on
// the triangles in the view's space, which in its image is interpolation with perspective.
//
// A triangle covers a point where all its edges have the point on the same side. Whether a point is on an edge's left is
// decided once for both triangles that share the edge, and a point on the edge is on its left in one direction only; so a
// closed surface leaves an even number of fragments.
#ifndef GNOMON_MATH_PRISM_H
#define GNOMON_MATH_PRISM_H
#include "texel_range.h"
GN_BEGIN

const uint kPrismTriangles = 14u;  // At most: 2 + 3 * 4.

// The line through two points of the image, homogeneous (x, y, w): its function at (x, y) is line.x * x + line.y * y + line.z.
// Swapping the points negates it exactly.
GN_FN vec3 line_through(vec3 p, vec3 q) {
    float a = p.y * q.z - q.y * p.z;
    float b = q.x * p.z - p.x * q.z;
    float c = p.x * q.y - q.x * p.y;
    return vec3(a, b, c);
}

struct LineAt {
    float value;
    bool left;  // Of the line's direction; decided by the line's slope for a point on it.
};

GN_FN LineAt line_at(vec3 line, float x, float y) {
    LineAt at;
    float value = line.x * x + line.y * y + line.z;
    at.value = value;
    at.left = value > 0.0f || (value == 0.0f && (line.x > 0.0f || (line.x == 0.0f && line.y > 0.0f)));
    return at;
}

// The side of the edge from vertex p to vertex q.
struct PrismSide {
    vec3 spoke_p0;  // Lines to the centre: from p and q at the start (0), from p and q at the end (1).
    vec3 spoke_q0;
    vec3 spoke_p1;
    vec3 spoke_q1;
    bool crossed;
    vec4 shares;   // Of the edge's lines, those from p to the crossing and from there to q: at the start (x, y), at the end (z,
                   // w).
    float metres;  // Of the centre or the crossing.
};

struct PrismSurface {
    vec3 start[3];  // Lines of the edges opposite each vertex.
    vec3 end[3];
    vec3 rise[3];  // From each vertex at the start to itself at the end.
    PrismSide side[3];
    vec3 start_metres;  // Of the vertices, along the view's axis.
    vec3 end_metres;
};

GN_FN float cross2(vec2 a, vec2 b) {
    float c = a.x * b.y - a.y * b.x;
    return c;
}

GN_FN vec2 image_point(vec3 p) { return vec2(p.x, p.y) / p.z; }

// The share of an edge in the view's space at which it projects to the share s of its image. w: of its ends.
GN_FN float share_in_space(float s, float w_from, float w_to) { return s * w_from / (s * w_from + (1.0f - s) * w_to); }

// Points are homogeneous, (x, y, w); metres: of p0, q0, p1, q1.
GN_FN PrismSide prism_side(vec3 p0, vec3 q0, vec3 p1, vec3 q1, vec4 metres) {
    PrismSide side;
    vec3 centre = 0.25f * (p0 + q0 + p1 + q1);
    side.spoke_p0 = line_through(p0, centre);
    side.spoke_q0 = line_through(q0, centre);
    side.spoke_p1 = line_through(p1, centre);
    side.spoke_q1 = line_through(q1, centre);
    // Eq. 1, with AB the edge at the start and CD at the end.
    vec2 a = image_point(p0), c = image_point(p1);
    vec2 ab = image_point(q0) - a, cd = image_point(q1) - c;
    float turn = cross2(ab, cd);
    float s = cross2(cd, a - c) / turn, u = cross2(ab, a - c) / turn;
    bool in_front = min(min(p0.z, q0.z), min(p1.z, q1.z)) > 0.0f;
    side.crossed = in_front && turn != 0.0f && s >= 0.0f && s <= 1.0f && u >= 0.0f && u <= 1.0f;
    float at_start = side.crossed ? share_in_space(s, p0.z, q0.z) : 0.5f;
    float at_end = side.crossed ? share_in_space(u, p1.z, q1.z) : 0.5f;
    float w_start = p0.z + at_start * (q0.z - p0.z), w_end = p1.z + at_end * (q1.z - p1.z);
    float w = 0.5f * (w_start + w_end);
    side.shares = vec4(vec2(at_start, 1.0f - at_start) * (w / w_start), vec2(at_end, 1.0f - at_end) * (w / w_end));
    float start_metres = metres.x + at_start * (metres.y - metres.x), end_metres = metres.z + at_end * (metres.w - metres.z);
    side.metres = side.crossed ? 0.5f * (start_metres + end_metres) : 0.25f * (metres.x + metres.y + metres.z + metres.w);
    return side;
}

GN_FN float metres_of(vec4 p, bool orthographic) { return orthographic ? p.z : p.w; }

// Of a prism in raster space, relative to the image point (cx, cy) near it.
GN_FN PrismSurface prism_surface(CellTriangle c, float cx, float cy, bool orthographic) {
    vec3 a0 = tile_relative(c.a0, cx, cy), a1 = tile_relative(c.a1, cx, cy), a2 = tile_relative(c.a2, cx, cy);
    vec3 b0 = tile_relative(c.b0, cx, cy), b1 = tile_relative(c.b1, cx, cy), b2 = tile_relative(c.b2, cx, cy);
    PrismSurface p;
    p.start_metres = vec3(metres_of(c.a0, orthographic), metres_of(c.a1, orthographic), metres_of(c.a2, orthographic));
    p.end_metres = vec3(metres_of(c.b0, orthographic), metres_of(c.b1, orthographic), metres_of(c.b2, orthographic));
    p.start[0] = line_through(a1, a2);
    p.start[1] = line_through(a2, a0);
    p.start[2] = line_through(a0, a1);
    p.end[0] = line_through(b1, b2);
    p.end[1] = line_through(b2, b0);
    p.end[2] = line_through(b0, b1);
    p.rise[0] = line_through(a0, b0);
    p.rise[1] = line_through(a1, b1);
    p.rise[2] = line_through(a2, b2);
    p.side[0] = prism_side(a1, a2, b1, b2, vec4(p.start_metres.y, p.start_metres.z, p.end_metres.y, p.end_metres.z));
    p.side[1] = prism_side(a2, a0, b2, b0, vec4(p.start_metres.z, p.start_metres.x, p.end_metres.z, p.end_metres.x));
    p.side[2] = prism_side(a0, a1, b0, b1, vec4(p.start_metres.x, p.start_metres.y, p.end_metres.x, p.end_metres.y));
    return p;
}

// Where the surface meets a line of sight: triangle i does if bit i of `covered` is set. Metres along the view's axis, and time
// within the cell.
struct PrismFragments {
    uint covered;
    float metres[kPrismTriangles];
    float time[kPrismTriangles];
};

// weights: of the triangle's vertices, all of one sign where it covers the point.
GN_FN void add_fragment(GN_INOUT(PrismFragments) f, uint i, bool covered, vec3 weights, vec3 metres, vec3 times,
                        float least_metres) {
    float sum = weights.x + weights.y + weights.z;
    bool point = sum == 0.0f;  // Of no area: the mean will do.
    vec3 w = point ? vec3(1.0f / 3.0f) : weights * (1.0f / sum);
    f.metres[i] = w.x * metres.x + w.y * metres.y + w.z * metres.z;
    f.time[i] = w.x * times.x + w.y * times.y + w.z * times.z;
    f.covered |= covered && f.metres[i] > least_metres ? 1u << i : 0u;
}

GN_FN bool all_same(bool a, bool b, bool c) { return a == b && b == c; }

// p, q: metres of the edge's ends at start and end.
GN_FN void add_side(GN_INOUT(PrismFragments) f, uint i, PrismSide side, LineAt start, LineAt end, LineAt rise_p, LineAt rise_q,
                    vec2 p, vec2 q, float x, float y, float least_metres) {
    LineAt p0 = line_at(side.spoke_p0, x, y), q0 = line_at(side.spoke_q0, x, y);
    LineAt p1 = line_at(side.spoke_p1, x, y), q1 = line_at(side.spoke_q1, x, y);
    bool crossed = side.crossed;
    float m = side.metres;
    // Around the centre c: (p0 q0 c), (q0 q1 c), (q1 p1 c), (p1 p0 c). With a crossing: (p0 c p1), (c q0 q1).
    add_fragment(f, i, crossed ? all_same(start.left, !end.left, !rise_p.left) : all_same(start.left, q0.left, !p0.left),
                 crossed ? vec3(-side.shares.z * end.value, -rise_p.value, side.shares.x * start.value)
                         : vec3(q0.value, -p0.value, start.value),
                 crossed ? vec3(p.x, m, p.y) : vec3(p.x, q.x, m), crossed ? vec3(0.0f, 0.5f, 1.0f) : vec3(0.0f, 0.0f, 0.5f),
                 least_metres);
    add_fragment(f, i + 1u, crossed ? all_same(start.left, rise_q.left, !end.left) : all_same(rise_q.left, q1.left, !q0.left),
                 crossed ? vec3(rise_q.value, -side.shares.w * end.value, side.shares.y * start.value)
                         : vec3(q1.value, -q0.value, rise_q.value),
                 crossed ? vec3(m, q.x, q.y) : vec3(q.x, q.y, m), crossed ? vec3(0.5f, 0.0f, 1.0f) : vec3(0.0f, 1.0f, 0.5f),
                 least_metres);
    add_fragment(f, i + 2u, !crossed && all_same(!end.left, p1.left, !q1.left), vec3(p1.value, -q1.value, -end.value),
                 vec3(q.y, p.y, m), vec3(1.0f, 1.0f, 0.5f), least_metres);
    add_fragment(f, i + 3u, !crossed && all_same(!rise_p.left, p0.left, !p1.left), vec3(p0.value, -p1.value, -rise_p.value),
                 vec3(p.y, p.x, m), vec3(1.0f, 0.0f, 0.5f), least_metres);
}

// (x, y): relative to the same point as the surface. Fragments at least_metres or nearer are none: behind the eye.
GN_FN PrismFragments fragments_at(PrismSurface s, float x, float y, float least_metres) {
    PrismFragments f;
    f.covered = 0u;
    LineAt a0 = line_at(s.start[0], x, y), a1 = line_at(s.start[1], x, y), a2 = line_at(s.start[2], x, y);
    LineAt b0 = line_at(s.end[0], x, y), b1 = line_at(s.end[1], x, y), b2 = line_at(s.end[2], x, y);
    LineAt r0 = line_at(s.rise[0], x, y), r1 = line_at(s.rise[1], x, y), r2 = line_at(s.rise[2], x, y);
    add_fragment(f, 0u, all_same(a0.left, a1.left, a2.left), vec3(a0.value, a1.value, a2.value), s.start_metres, vec3(0.0f),
                 least_metres);
    add_fragment(f, 1u, all_same(b0.left, b1.left, b2.left), vec3(b0.value, b1.value, b2.value), s.end_metres, vec3(1.0f),
                 least_metres);
    f.time[1] = 1.0f;  // Without rounding: temporal asks for the whole shutter.
    add_side(f, 2u, s.side[0], a0, b0, r1, r2, vec2(s.start_metres.y, s.end_metres.y), vec2(s.start_metres.z, s.end_metres.z),
             x, y, least_metres);
    add_side(f, 6u, s.side[1], a1, b1, r2, r0, vec2(s.start_metres.z, s.end_metres.z), vec2(s.start_metres.x, s.end_metres.x),
             x, y, least_metres);
    add_side(f, 10u, s.side[2], a2, b2, r0, r1, vec2(s.start_metres.x, s.end_metres.x), vec2(s.start_metres.y, s.end_metres.y),
             x, y, least_metres);
    return f;
}

GN_END
#endif
