// SPDX-License-Identifier: Apache-2.0
// Which triangles are listed: those of a part of the scene, and of them those that may shadow something. Of closed shells the orientation that looks away is enough; what stands still on the scene's hull shadows nothing while the eye
// is on the scene's side of it. Needs: triangles, shells, closed, positions, still (pose/still); kPart; params.box_lower and params.box_upper (the scene's
// box, at all keys); math/orientation.h

bool stands_still(uint triangle) { return (fetch_still(triangle >> 5u) >> (triangle & 31u) & 1u) != 0u; }

bool in_part(uint triangle) { return kPart == kWholeScene || stands_still(triangle) == (kPart == kStillPart); }

// The orientation in which the eye sees a triangle from the side on which the whole scene lies; 0 where it lies on both, or the triangle moves.
uint hull_orientation(uint triangle) {
    uvec3 v = fetch_triangles(triangle).xyz;
    vec3 p0 = fetch_positions(v.x).xyz, p1 = fetch_positions(v.y).xyz, p2 = fetch_positions(v.z).xyz;
    vec3 n = cross3(p1 - p0, p2 - p0);
    vec3 a = n * (params.box_lower - p0), b = n * (params.box_upper - p0);
    vec3 low = min(a, b), high = max(a, b);
    uint orientation = low.x + low.y + low.z >= 0.0 ? kSeenNegative : (high.x + high.y + high.z <= 0.0 ? kSeenPositive : 0u);
    return stands_still(triangle) ? orientation : 0u;
}

// Of the orientations in which a triangle may be seen those in which it may shadow something.
uint casting(uint triangle, uint seen) {
    bool closed = fetch_closed(fetch_shells(triangle)) != 0u;
    return seen & (closed ? kSeenAway : ~hull_orientation(triangle));
}
