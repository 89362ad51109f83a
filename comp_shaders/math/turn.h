// SPDX-License-Identifier: Apache-2.0
// Between two rotations. Without sines of the device: Vulkan lets them be off by 2^-11, and drivers differ in them.
#ifndef GNOMON_MATH_TURN_H
#define GNOMON_MATH_TURN_H
#include "../shared/lang.h"
GN_BEGIN

// sin(s * angle) / angle, to 6e-8 where s * angle is from 0 to pi / 2: its series.
GN_FN float sine_share(float s, float angle) {
    float y = s * angle * (s * angle);
    float p = 1.0f - y * (1.0f / 110.0f);
    p = 1.0f - y * (1.0f / 72.0f) * p;
    p = 1.0f - y * (1.0f / 42.0f) * p;
    p = 1.0f - y * (1.0f / 20.0f) * p;
    return s * (1.0f - y * (1.0f / 6.0f) * p);
}

// Spherical interpolation of unit quaternions (x, y, z, w) that are `angle` apart, from 0 to pi / 2; s from 0 to 1.
GN_FN vec4 turn_between(vec4 a, vec4 b, float angle, float s) {
    vec4 q = sine_share(1.0f - s, angle) * a + sine_share(s, angle) * b;
    return q / sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
}

GN_END
#endif
