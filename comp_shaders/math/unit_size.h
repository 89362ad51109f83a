// SPDX-License-Identifier: Apache-2.0
// Sizes near 1, so that squares neither overflow nor vanish. Powers of two: the scaling is exact.
#ifndef GNOMON_MATH_UNIT_SIZE_H
#define GNOMON_MATH_UNIT_SIZE_H
#include "../shared/lang.h"
GN_BEGIN

// What makes a number, not negative, one from 1 to 2; less of one below 1.2e-38, more of one from 8.5e37.
GN_FN float unit_scale(float largest) {
    float scale = uintBitsToFloat((254u << 23u) - (min(floatBitsToUint(max(largest, 1.2e-38f)), 253u << 23u) & 0x7f800000u));
    return scale;
}

GN_FN vec3 unit_size(vec3 v) {
    float scale = unit_scale(max(max(abs(v.x), abs(v.y)), abs(v.z)));
    return vec3(v.x * scale, v.y * scale, v.z * scale);
}

GN_END
#endif
