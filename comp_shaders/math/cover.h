// SPDX-License-Identifier: Apache-2.0
// Does a moving triangle cover a point of a view's image at a time, and how deep is it there?
// Based on: Olano and Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates"; Akenine-Moller et al. 2007,
// "Stochastic rasterization using time-continuous triangles".
//
// A vertex in a view's raster space is homogeneous: (x, y, z, w). x / w and y / w are texels (pixels) from the image's centre,
// x to the right and y down; z / w is the depth. Orthographic views: w = 1, z = metres along the view axis. Perspective views:
// w = metres along the view axis, z = -1, so that the depth -1 / w grows with the distance and stays exact for vertices behind
// the eye.
#ifndef GNOMON_MATH_COVER_H
#define GNOMON_MATH_COVER_H
#include "../shared/lang.h"
GN_BEGIN

// A vertex that moves from a to a + d in one segment, at local time s.
GN_FN vec4 vertex_at(vec4 a, vec4 d, float s) {
    vec4 p;
    p.x = a.x + s * d.x;
    p.y = a.y + s * d.y;
    p.z = a.z + s * d.z;
    p.w = a.w + s * d.w;
    return p;
}

// The vertex as seen from the image point (x, y): where it projects onto the point, the result is zero.
GN_FN vec2 relative_to(vec4 p, float x, float y) {
    vec2 r;
    r.x = p.x - x * p.w;
    r.y = p.y - y * p.w;
    return r;
}

// Edge function of the edge p -> q at the origin. Swapping p and q negates the result exactly, so that two triangles which
// share an edge leave no crack along it.
GN_FN float edge_at_origin(vec2 p, vec2 q) {
    float e = p.x * q.y - q.x * p.y;
    return e;
}

// The three edge functions of the triangle p0 p1 p2 at the image point (x, y); e.k belongs to the edge opposite vertex k. With
// the triangle's positive orientation all three are >= 0 where it covers the point with w > 0. Barycentrics are e / (e.x + e.y
// + e.z).
GN_FN vec3 edges_at(vec4 p0, vec4 p1, vec4 p2, float x, float y) {
    vec2 r0 = relative_to(p0, x, y);
    vec2 r1 = relative_to(p1, x, y);
    vec2 r2 = relative_to(p2, x, y);
    return vec3(edge_at_origin(r1, r2), edge_at_origin(r2, r0), edge_at_origin(r0, r1));
}

GN_FN bool covers(vec3 e) { return min(min(e.x, e.y), e.z) >= 0.0f; }

// Depth z / w of the triangle's plane at the point that e belongs to.
GN_FN float depth_orthographic(vec3 e, vec4 p0, vec4 p1, vec4 p2) {
    float zn = e.x * p0.z + e.y * p1.z + e.z * p2.z;
    float wn = e.x * p0.w + e.y * p1.w + e.z * p2.w;
    return zn / wn;
}

GN_FN float depth_perspective(vec3 e, vec4 p0, vec4 p1, vec4 p2) {
    float wn = e.x * p0.w + e.y * p1.w + e.z * p2.w;
    float sum = e.x + e.y + e.z;
    return -sum / wn;
}

GN_END
#endif
