// SPDX-License-Identifier: Apache-2.0
// Where a point that stays in place before a moving camera goes in a moving light's view.
// Based on: Andersson et al. 2015, "Filtered stochastic shadow mapping using a layered approach", section 4.2.
#ifndef GNOMON_MATH_FOOTPRINT_H
#define GNOMON_MATH_FOOTPRINT_H
#include "range.h"
GN_BEGIN

// A view at a key: three rows of its raster transform (x, y; metres along the axis, or w), for points relative to the origin.
struct ViewRows {
    vec4 row[3];
    vec3 origin;
};

// A view at a time near a point p: value + change * (q - p) is where it sees q.
struct ViewNear {
    vec3 value;
    vec3 change[3];  // Rows.
};

GN_FN float dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

GN_FN float in_row(vec4 row, vec3 p) { return row.x * p.x + row.y * p.y + row.z * p.z + row.w; }

// Between two keys, a and b, at local time s; motion is linear in raster space.
GN_FN ViewNear view_near(ViewRows a, ViewRows b, float s, vec3 p) {
    vec3 pa = p - a.origin;
    vec3 pb = p - b.origin;
    vec3 v0 = vec3(in_row(a.row[0], pa), in_row(a.row[1], pa), in_row(a.row[2], pa));
    vec3 v1 = vec3(in_row(b.row[0], pb), in_row(b.row[1], pb), in_row(b.row[2], pb));
    ViewNear v;
    v.value = v0 + s * (v1 - v0);
    for (int i = 0; i < 3; ++i) {
        vec3 d0 = vec3(a.row[i].x, a.row[i].y, a.row[i].z);
        vec3 d1 = vec3(b.row[i].x, b.row[i].y, b.row[i].z);
        v.change[i] = d0 + s * (d1 - d0);
    }
    return v;
}

GN_FN vec3 seen_at(ViewNear v, vec3 offset) {
    return v.value + vec3(dot3(v.change[0], offset), dot3(v.change[1], offset), dot3(v.change[2], offset));
}

// How far from p the point is that the view sees at `value` (Cramer's rule).
GN_FN vec3 offset_of(ViewNear v, vec3 value) {
    vec3 want = value - v.value;
    vec3 c0 = cross3(v.change[1], v.change[2]);
    vec3 c1 = cross3(v.change[2], v.change[0]);
    vec3 c2 = cross3(v.change[0], v.change[1]);
    float determinant = dot3(v.change[0], c0);
    return (want.x * c0 + want.y * c1 + want.z * c2) * (1.0f / determinant);
}

GN_END
#endif
