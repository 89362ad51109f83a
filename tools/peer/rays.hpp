// SPDX-License-Identifier: Apache-2.0
// A batch of rays in arrays, and the ways to hand them to Embree.
#pragma once

#include "embree.hpp"
#include "peer.hpp"

namespace gnomon::peer {

inline constexpr uint32_t kBatch = 256;  ///< A multiple of every packet.

/// Only the first `count` rays are traced. The last four arrays are the same for all rays and stay as they are constructed.
struct alignas(64) Rays {
    uint32_t count = 0;
    alignas(64) float org_x[kBatch] = {}, org_y[kBatch] = {}, org_z[kBatch] = {}, tnear[kBatch] = {};
    float dir_x[kBatch] = {}, dir_y[kBatch] = {}, dir_z[kBatch] = {}, time[kBatch] = {};
    float tfar[kBatch] = {};  ///< After a hit its distance; after occlusion negative.
    float ng_x[kBatch] = {}, ng_y[kBatch] = {}, ng_z[kBatch] = {}, u[kBatch] = {}, v[kBatch] = {};
    uint32_t triangle[kBatch] = {}, geometry[kBatch] = {};  ///< geometry is RTC_INVALID_GEOMETRY_ID after a miss.
    uint32_t mask[kBatch], id[kBatch] = {}, flags[kBatch] = {}, instance[kBatch];
    Rays();
};

void intersect(RTCScene scene, RayCalls calls, Rays& rays);
void occluded(RTCScene scene, RayCalls calls, Rays& rays);

}  // namespace gnomon::peer
