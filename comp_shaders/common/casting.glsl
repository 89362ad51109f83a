// SPDX-License-Identifier: Apache-2.0
// Which triangles may shadow something. Of closed shells the orientation that looks away is enough; what stands still on the scene's hull shadows nothing while the eye
// is on the scene's side of it. Needs: triangles, shells, closed, positions; params.grid, params.box_lower and params.box_upper (the scene's box, at all keys);
// math/orientation.h

// The orientation in which the eye sees a triangle from the side on which the whole scene lies; 0 where it lies on both, or the triangle moves.
uint hull_orientation(uint triangle, uint key_first) {
    uvec3 v = fetch_triangles(triangle).xyz + key_first;
    vec3 p0 = fetch_positions(v.x).xyz, p1 = fetch_positions(v.y).xyz, p2 = fetch_positions(v.z).xyz;
    uvec3 next = v + params.grid.vertex_stride;
    bool still = p0 == fetch_positions(next.x).xyz && p1 == fetch_positions(next.y).xyz && p2 == fetch_positions(next.z).xyz;
    vec3 n = cross3(p1 - p0, p2 - p0);
    vec3 a = n * (params.box_lower - p0), b = n * (params.box_upper - p0);
    vec3 low = min(a, b), high = max(a, b);
    uint orientation = low.x + low.y + low.z >= 0.0 ? kSeenNegative : (high.x + high.y + high.z <= 0.0 ? kSeenPositive : 0u);
    return still ? orientation : 0u;
}

// Of the orientations in which a triangle may be seen those in which it may shadow something.
uint casting(uint triangle, uint seen, uint key_first) {
    bool closed = fetch_closed(fetch_shells(triangle)) != 0u;
    return seen & (closed ? kSeenAway : ~hull_orientation(triangle, key_first));
}
