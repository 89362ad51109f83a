// SPDX-License-Identifier: Apache-2.0
// What lets one header be C++ and GLSL. Headers that include this use only + - * / sqrt, comparisons and integer operations, so
// that the host (built with -ffp-contract=off) and the device (whose SPIR-V forbids contraction) compute the same bits.
#ifndef GNOMON_SHARED_LANG_H
#define GNOMON_SHARED_LANG_H

#ifdef __cplusplus
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#define GN_FN inline
#define GN_OUT(T) T&
#define GN_INOUT(T) T&
#define GN_BEGIN namespace gnomon::shared {
#define GN_END }
GN_BEGIN
using uint = uint32_t;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using std::sqrt;
inline float abs(float a) { return std::fabs(a); }
inline float floor(float a) { return std::floor(a); }
inline float ceil(float a) { return std::ceil(a); }
inline float min(float a, float b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline uint min(uint a, uint b) { return b < a ? b : a; }
inline uint max(uint a, uint b) { return a < b ? b : a; }
inline uint floatBitsToUint(float a) { return std::bit_cast<uint>(a); }
inline float uintBitsToFloat(uint a) { return std::bit_cast<float>(a); }
GN_END
#else
#define GN_FN
#define GN_OUT(T) out T
#define GN_INOUT(T) inout T
#define GN_BEGIN
#define GN_END
#endif

#endif
