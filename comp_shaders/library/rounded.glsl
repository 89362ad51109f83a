// SPDX-License-Identifier: Apache-2.0
// Times and depths of ranges in fewer bits, rounded outward: a range that is read contains the one that was written. Steps are a power of two, so that the way there and
// back is exact.

// The step of the shutter in which a range begins; beyond the shutter nobody asks.
uint enter_step(float t, float steps) { return uint(clamp(floor(t * steps), 0.0, steps - 1.0)); }
float enter_of(uint step, float steps) { return float(step) * (1.0 / steps); }

// The step at whose end it ends.
uint leave_step(float t, float steps) { return uint(clamp(ceil(t * steps), 1.0, steps) - 1.0); }
float leave_of(uint step, float steps) { return float(step + 1u) * (1.0 / steps); }

// A depth's upper 16 bits in the order of floats, whose lower ones are taken for those of what is nearest.
uint nearer_half(float depth) {
    uint bits = floatBitsToUint(max(depth, -kFarthest));
    return ((bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u) >> 16u;
}
float depth_of_half(uint upper) {
    uint ordered = upper << 16u;
    return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}
