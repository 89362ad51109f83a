// SPDX-License-Identifier: Apache-2.0
// Floats as integers in the same order, for what is defined of integers only: atomics, minima over many invocations.
#ifndef GNOMON_MATH_ORDER_H
#define GNOMON_MATH_ORDER_H
#include "../shared/lang.h"
GN_BEGIN

// Of any float but NaN; -0 comes before 0.
GN_FN uint ordered_bits(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

GN_FN float from_ordered_bits(uint ordered) {
    return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

GN_FN bool finite_bits(float value) { return (floatBitsToUint(value) & 0x7f800000u) != 0x7f800000u; }

GN_END
#endif
