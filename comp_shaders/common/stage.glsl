// SPDX-License-Identifier: Apache-2.0
// What every stage includes first: extensions, reads, the device's threads and the number of its workgroup.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/params.h"

// Read-only data, declared as READ_UVEC4(2, triangles) at binding 2 and read as fetch_triangles(i). A device sees it as a texel buffer, which is fast on lavapipe, or,
// with GN_STORAGE_READS, as a storage buffer, which holds more elements on some (Limits::storage_reads).
#ifdef GN_STORAGE_READS
#define GN_READ_AS(slot, sampler, stored, type, name, parts) \
    layout(binding = slot, scalar) readonly buffer name { stored name##_elements[]; }; \
    type fetch_##name(uint i) { return type(name##_elements[i]); }
#define READ_COUNT(name) uint(name##_elements.length())
#else
#define GN_READ_AS(slot, sampler, stored, type, name, parts) \
    layout(binding = slot) uniform sampler name; \
    type fetch_##name(uint i) { return texelFetch(name, int(i)).parts; }
#define READ_COUNT(name) uint(textureSize(name))
#endif
#define GN_READ(slot, sampler, type, name, parts) GN_READ_AS(slot, sampler, type, type, name, parts)
#define READ_FLOAT(slot, name) GN_READ(slot, samplerBuffer, float, name, x)
#define READ_VEC2(slot, name) GN_READ(slot, samplerBuffer, vec2, name, xy)
#define READ_VEC4(slot, name) GN_READ(slot, samplerBuffer, vec4, name, xyzw)
#define READ_UINT(slot, name) GN_READ(slot, usamplerBuffer, uint, name, x)
#define READ_UVEC2(slot, name) GN_READ(slot, usamplerBuffer, uvec2, name, xy)
#define READ_UVEC4(slot, name) GN_READ(slot, usamplerBuffer, uvec4, name, xyzw)

layout(constant_id = kThreadsConstant) const uint kThreads = 1u;  // Of the device, each of which takes one contiguous part of a dispatch.

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// a / b for a < 2^24, without lavapipe's slow division: by floats, then put right by the remainder.
uint divide(uint a, uint b) {
    uint q = uint(float(a) / float(b));
    int remainder = int(a - q * b);
    return remainder < 0 ? q - 1u : (remainder >= int(b) ? q + 1u : q);
}
