// SPDX-License-Identifier: Apache-2.0
// Faces: the projections of a light that no single plane holds, 90 degrees each, along the axes of the light's frame (a point
// light's are the world's).
#ifndef GNOMON_MATH_FACE_H
#define GNOMON_MATH_FACE_H
#include "../shared/lang.h"
GN_BEGIN

// Faces are numbered +x, -x, +y, -y, +z, -z.
const uint kFaceCount = 6u;
const uint kOnlyFace = kFaceCount;  // Of a light that one plane holds.

// The one face that a direction from the light belongs to: that of its longest component; of equally long ones the first.
GN_FN uint face_of(vec3 d) {
    float x = abs(d.x), y = abs(d.y), z = abs(d.z);
    uint axis = x >= y && x >= z ? 0u : (y >= z ? 1u : 2u);
    float along = axis == 0u ? d.x : (axis == 1u ? d.y : d.z);
    return 2u * axis + (along < 0.0f ? 1u : 0u);
}

GN_END
#endif
