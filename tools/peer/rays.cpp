// SPDX-License-Identifier: Apache-2.0
// A batch of rays in arrays, and the ways to hand them to Embree.
#include "rays.hpp"

#include <algorithm>
#include <cstring>

namespace gnomon::peer {
namespace {

using reference::RayQuery;

template <class T, size_t N>
void take(T (&to)[N], const T* from) {
    std::memcpy(to, from, sizeof(to));
}

template <class T, size_t N>
void give(T* to, const T (&from)[N]) {
    std::memcpy(to, from, sizeof(from));
}

template <class Packet>
void take_rays(Packet& packet, const Rays& rays, uint32_t first) {
    take(packet.org_x, rays.org_x + first);
    take(packet.org_y, rays.org_y + first);
    take(packet.org_z, rays.org_z + first);
    take(packet.tnear, rays.tnear + first);
    take(packet.dir_x, rays.dir_x + first);
    take(packet.dir_y, rays.dir_y + first);
    take(packet.dir_z, rays.dir_z + first);
    take(packet.time, rays.time + first);
    take(packet.tfar, rays.tfar + first);
    take(packet.mask, rays.mask);
    take(packet.flags, rays.flags);
}

template <uint32_t N>
void set_valid(int (&valid)[N], uint32_t count) {
    for (uint32_t lane = 0; lane < N; ++lane) valid[lane] = lane < count ? -1 : 0;
}

template <class Packet, uint32_t N>
void intersect_packets(RTCScene scene, RayQuery& query, Rays& rays) {
    alignas(64) int valid[N];
    alignas(64) Packet packet;
    for (uint32_t first = 0; first < rays.count; first += N) {
        set_valid(valid, rays.count - first);
        take_rays(packet.ray, rays, first);
        take(packet.hit.geomID, rays.instance);
        intersect(valid, scene, query, packet);
        give(rays.tfar + first, packet.ray.tfar);
        give(rays.ng_x + first, packet.hit.Ng_x);
        give(rays.ng_y + first, packet.hit.Ng_y);
        give(rays.ng_z + first, packet.hit.Ng_z);
        give(rays.u + first, packet.hit.u);
        give(rays.v + first, packet.hit.v);
        give(rays.triangle + first, packet.hit.primID);
        give(rays.geometry + first, packet.hit.geomID);
    }
}

template <class Packet, uint32_t N>
void occlude_packets(RTCScene scene, RayQuery& query, Rays& rays) {
    alignas(64) int valid[N];
    alignas(64) Packet packet;
    for (uint32_t first = 0; first < rays.count; first += N) {
        set_valid(valid, rays.count - first);
        take_rays(packet, rays, first);
        occluded(valid, scene, query, packet);
        give(rays.tfar + first, packet.tfar);
    }
}

RTCRay single_ray(const Rays& rays, uint32_t i) {
    RTCRay ray;
    ray.org_x = rays.org_x[i];
    ray.org_y = rays.org_y[i];
    ray.org_z = rays.org_z[i];
    ray.tnear = rays.tnear[i];
    ray.dir_x = rays.dir_x[i];
    ray.dir_y = rays.dir_y[i];
    ray.dir_z = rays.dir_z[i];
    ray.time = rays.time[i];
    ray.tfar = rays.tfar[i];
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return ray;
}

void intersect_single(RTCScene scene, RayQuery& query, Rays& rays) {
    for (uint32_t i = 0; i < rays.count; ++i) {
        RTCRayHit one;
        one.ray = single_ray(rays, i);
        one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        intersect(scene, query, one);
        rays.tfar[i] = one.ray.tfar;
        rays.ng_x[i] = one.hit.Ng_x;
        rays.ng_y[i] = one.hit.Ng_y;
        rays.ng_z[i] = one.hit.Ng_z;
        rays.u[i] = one.hit.u;
        rays.v[i] = one.hit.v;
        rays.triangle[i] = one.hit.primID;
        rays.geometry[i] = one.hit.geomID;
    }
}

void occlude_single(RTCScene scene, RayQuery& query, Rays& rays) {
    for (uint32_t i = 0; i < rays.count; ++i) {
        RTCRay one = single_ray(rays, i);
        occluded(scene, query, one);
        rays.tfar[i] = one.tfar;
    }
}

}  // namespace

Rays::Rays() {
    std::fill_n(mask, kBatch, ~0u);
    std::fill_n(instance, kBatch, RTC_INVALID_GEOMETRY_ID);
}

void intersect(RTCScene scene, RayCalls calls, Rays& rays) {
    RayQuery query;
    init(query, true);
    switch (calls) {
        case RayCalls::single:
            return intersect_single(scene, query, rays);
        case RayCalls::packets_of_8:
            return intersect_packets<RTCRayHit8, 8>(scene, query, rays);
        case RayCalls::packets_of_16:
            return intersect_packets<RTCRayHit16, 16>(scene, query, rays);
        case RayCalls::stream:
            return reference::intersect_stream(scene, query, rays);
    }
}

void occluded(RTCScene scene, RayCalls calls, Rays& rays) {
    RayQuery query;
    init(query, true);
    switch (calls) {
        case RayCalls::single:
            return occlude_single(scene, query, rays);
        case RayCalls::packets_of_8:
            return occlude_packets<RTCRay8, 8>(scene, query, rays);
        case RayCalls::packets_of_16:
            return occlude_packets<RTCRay16, 16>(scene, query, rays);
        case RayCalls::stream:
            return reference::occluded_stream(scene, query, rays);
    }
}

}  // namespace gnomon::peer
