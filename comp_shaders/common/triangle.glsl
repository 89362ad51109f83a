// SPDX-License-Identifier: Apache-2.0
// Fetching moving triangles in raster space. Needs: triangles (vertex 0, 1, 2, material), raster_vertices (key-major).
#include "math/cover.h"

// The vertices at a segment's start (a) and their motion until its end (d).
struct MovingTriangle {
    vec4 a0, a1, a2;
    vec4 d0, d1, d2;
};

// `entry` is a list's entry: a triangle, reversed or not.
MovingTriangle fetch_moving_triangle(uint entry, uint key_first, uint vertex_stride) {
    uvec3 v = fetch_triangles(entry & ~kReversed).xyz;
    bool reversed = (entry & kReversed) != 0u;
    uint i0 = key_first + v.x;
    uint i1 = key_first + (reversed ? v.z : v.y);
    uint i2 = key_first + (reversed ? v.y : v.z);
    MovingTriangle m;
    m.a0 = fetch_raster_vertices(i0);
    m.a1 = fetch_raster_vertices(i1);
    m.a2 = fetch_raster_vertices(i2);
    m.d0 = fetch_raster_vertices(i0 + vertex_stride) - m.a0;
    m.d1 = fetch_raster_vertices(i1 + vertex_stride) - m.a1;
    m.d2 = fetch_raster_vertices(i2 + vertex_stride) - m.a2;
    return m;
}

// x and y by a power of two, which rounds nothing.
MovingTriangle scaled(MovingTriangle m, float scale) {
    vec4 by = vec4(scale, scale, 1.0, 1.0);
    return MovingTriangle(m.a0 * by, m.a1 * by, m.a2 * by, m.d0 * by, m.d1 * by, m.d2 * by);
}
