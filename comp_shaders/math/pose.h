// SPDX-License-Identifier: Apache-2.0
// One vertex, posed: glTF 2.0, 3.7.2.2 (morph targets) and 3.7.3 (skins).
#ifndef GNOMON_MATH_POSE_H
#define GNOMON_MATH_POSE_H
#include "../shared/lang.h"
#include "unit_size.h"
GN_BEGIN

// rest + weight * delta, one morph target.
GN_FN vec3 morph_add(vec3 rest, vec3 delta, float weight) {
    vec3 r;
    r.x = rest.x + weight * delta.x;
    r.y = rest.y + weight * delta.y;
    r.z = rest.z + weight * delta.z;
    return r;
}

// One row of a palette matrix times (p, 1).
GN_FN float row_times_point(vec4 row, vec3 p) {
    float r = row.x * p.x + row.y * p.y + row.z * p.z + row.w;
    return r;
}

// sum + weight * (matrix * (p, 1)); the matrix's three rows.
GN_FN vec3 skin_add(vec3 sum, vec4 row_x, vec4 row_y, vec4 row_z, vec3 p, float weight) {
    vec3 r;
    r.x = sum.x + weight * row_times_point(row_x, p);
    r.y = sum.y + weight * row_times_point(row_y, p);
    r.z = sum.z + weight * row_times_point(row_z, p);
    return r;
}

// sum + weight * (cofactor matrix * n): normals go with the inverse transpose, here up to a positive factor and the
// determinant's sign.
GN_FN vec3 skin_add_normal(vec3 sum, vec4 row_x, vec4 row_y, vec4 row_z, vec3 n, float weight) {
    vec3 cx = vec3(row_y.y * row_z.z - row_y.z * row_z.y, row_y.z * row_z.x - row_y.x * row_z.z,
                   row_y.x * row_z.y - row_y.y * row_z.x);
    vec3 cy = vec3(row_z.y * row_x.z - row_z.z * row_x.y, row_z.z * row_x.x - row_z.x * row_x.z,
                   row_z.x * row_x.y - row_z.y * row_x.x);
    vec3 cz = vec3(row_x.y * row_y.z - row_x.z * row_y.y, row_x.z * row_y.x - row_x.x * row_y.z,
                   row_x.x * row_y.y - row_x.y * row_y.x);
    vec3 m =
        vec3(cx.x * n.x + cx.y * n.y + cx.z * n.z, cy.x * n.x + cy.y * n.y + cy.z * n.z, cz.x * n.x + cz.y * n.y + cz.z * n.z);
    m = unit_size(m);
    float length2 = m.x * m.x + m.y * m.y + m.z * m.z;
    float scale = length2 > 0.0f ? weight / sqrt(length2) : 0.0f;
    return vec3(sum.x + scale * m.x, sum.y + scale * m.y, sum.z + scale * m.z);
}

GN_END
#endif
