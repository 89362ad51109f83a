// SPDX-License-Identifier: Apache-2.0
// Where and when a pixel is sampled: a rotated Kronecker lattice in (x, y) over strata of time.
// Based on: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (the R2 constants); Jarzynski and Olano
// 2020, "Hash functions for GPU rendering" (pcg).
#ifndef GNOMON_MATH_SAMPLE_H
#define GNOMON_MATH_SAMPLE_H
#include "../shared/lang.h"
GN_BEGIN

GN_FN uint hash_pcg(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// The upper 24 bits as a float in [0, 1).
GN_FN float unit_float(uint bits) { return float(bits >> 8u) * (1.0f / 16777216.0f); }

// The start of a pixel's own lattice; every pixel and seed has another.
GN_FN uint pixel_hash(uint x_px, uint y_px, uint seed) { return hash_pcg(x_px + hash_pcg(y_px + hash_pcg(seed))); }

// Of the samples of a light's view.
GN_FN uint light_seed(uint seed, uint light) { return hash_pcg(seed ^ hash_pcg(light + 1u)); }

#ifdef __cplusplus
// The length of each of `spp` strata of the shutter. The host divides and the device multiplies, since a device need not round
// quotients correctly: so all agree on every sample's time.
inline float stratum_length(uint spp) { return 1.0f / float(spp); }
#endif

// When stratum `s` begins, and the one before it ends.
GN_FN float stratum_start(uint s, float length) { return float(s) * length; }

// The sample in stratum `s` of pixel (x_px, y_px): (x, y) in pixels, t in the shutter. x_px <= x <= x_px + 1 (closed: float
// rounding), likewise y; stratum_start(s) <= t < stratum_start(s + 1) <= 1. `pixel` is pixel_hash(x_px, y_px, seed), `length`
// the strata's. The sample depends on nothing else, so any split of the samples over runs gives the same ones.
GN_FN vec3 sample_point(uint pixel, uint x_px, uint y_px, uint s, float length) {
    uint hx = hash_pcg(pixel ^ 0x9e3779b9u);
    uint hy = hash_pcg(hx);
    uint ht = hash_pcg(pixel + s * 0x9e3779b1u);
    float x = float(x_px) + unit_float(hx + s * 3242174889u);
    float y = float(y_px) + unit_float(hy + s * 2447445414u);
    float t = (float(s) + unit_float(ht)) * length;
    t = min(t, uintBitsToFloat(floatBitsToUint(stratum_start(s + 1u, length)) - 1u));
    return vec3(x, y, t);
}

// The sample in stratum `s` that all pixels take at one time: the pixel's centre in the middle of the stratum.
GN_FN vec3 slice_point(uint x_px, uint y_px, uint s, float length) {
    return vec3(float(x_px) + 0.5f, float(y_px) + 0.5f, (float(s) + 0.5f) * length);
}

// Time t of the shutter as local time of one of its segments: 0 where the segment starts.
GN_FN float local_time_of(float t, uint segment, uint segment_count) {
    float local = t * float(segment_count) - float(segment);
    return local;
}

// The cell, of `cell_count` equal ones, that time t in [0, 1) lies in.
GN_FN uint cell_of(float t, uint cell_count) { return min(uint(t * float(cell_count)), cell_count - 1u); }

GN_END
#endif
