// SPDX-License-Identifier: Apache-2.0
// Embree 3 or 4, whichever was found: all that differs between them.
#pragma once

#if GNOMON_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cstdint>
#include <gnomon/error.hpp>

namespace gnomon::reference {

#if GNOMON_EMBREE == 4

/// What rays ask with. Filters are handed its address as their context.
struct RayQuery {
    RTCRayQueryContext context;
    bool coherent;
};

inline void init(RayQuery& query, bool coherent) {
    rtcInitRayQueryContext(&query.context);
    query.coherent = coherent;
}

/// RTCIntersectArguments or RTCOccludedArguments.
template <class Arguments>
Arguments arguments_of(RayQuery& query) {
    Arguments arguments{};  // As rtcInitIntersectArguments and rtcInitOccludedArguments would leave it, but for what follows.
    arguments.flags = query.coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    arguments.feature_mask = RTC_FEATURE_FLAG_ALL;
    arguments.context = &query.context;
    return arguments;
}

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& rays) {
    auto arguments = arguments_of<RTCIntersectArguments>(query);
    rtcIntersect1(scene, &rays, &arguments);
}
inline void intersect(const int* valid, RTCScene scene, RayQuery& query, RTCRayHit8& rays) {
    auto arguments = arguments_of<RTCIntersectArguments>(query);
    rtcIntersect8(valid, scene, &rays, &arguments);
}
inline void intersect(const int* valid, RTCScene scene, RayQuery& query, RTCRayHit16& rays) {
    auto arguments = arguments_of<RTCIntersectArguments>(query);
    rtcIntersect16(valid, scene, &rays, &arguments);
}
inline void occluded(RTCScene scene, RayQuery& query, RTCRay& rays) {
    auto arguments = arguments_of<RTCOccludedArguments>(query);
    rtcOccluded1(scene, &rays, &arguments);
}
inline void occluded(const int* valid, RTCScene scene, RayQuery& query, RTCRay8& rays) {
    auto arguments = arguments_of<RTCOccludedArguments>(query);
    rtcOccluded8(valid, scene, &rays, &arguments);
}
inline void occluded(const int* valid, RTCScene scene, RayQuery& query, RTCRay16& rays) {
    auto arguments = arguments_of<RTCOccludedArguments>(query);
    rtcOccluded16(valid, scene, &rays, &arguments);
}

/// Rays in arrays of their own, as many as `rays.count`. Only Embree 3 takes them. Errors: ErrorKind::internal in Embree 4.
inline constexpr bool kHasStreams = false;

template <class Arrays>
void intersect_stream(RTCScene, RayQuery&, Arrays&) {
    throw Error(ErrorKind::internal, "Embree 4 has no streams of rays", "", "ask by packets");
}
template <class Arrays>
void occluded_stream(RTCScene, RayQuery&, Arrays&) {
    throw Error(ErrorKind::internal, "Embree 4 has no streams of rays", "", "ask by packets");
}

#else

/// What rays ask with. Filters are handed its address as their context.
struct RayQuery {
    RTCIntersectContext context;
};

inline void init(RayQuery& query, bool coherent) {
    rtcInitIntersectContext(&query.context);
    query.context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& rays) { rtcIntersect1(scene, &query.context, &rays); }
inline void intersect(const int* valid, RTCScene scene, RayQuery& query, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &query.context, &rays);
}
inline void intersect(const int* valid, RTCScene scene, RayQuery& query, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &query.context, &rays);
}
inline void occluded(RTCScene scene, RayQuery& query, RTCRay& rays) { rtcOccluded1(scene, &query.context, &rays); }
inline void occluded(const int* valid, RTCScene scene, RayQuery& query, RTCRay8& rays) {
    rtcOccluded8(valid, scene, &query.context, &rays);
}
inline void occluded(const int* valid, RTCScene scene, RayQuery& query, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &query.context, &rays);
}

inline constexpr bool kHasStreams = true;

template <class Arrays>
RTCRayNp pointers_to(Arrays& rays) {
    return {rays.org_x, rays.org_y, rays.org_z, rays.tnear, rays.dir_x, rays.dir_y,
            rays.dir_z, rays.time,  rays.tfar,  rays.mask,  rays.id,    rays.flags};
}
template <class Arrays>
void intersect_stream(RTCScene scene, RayQuery& query, Arrays& rays) {
    std::ranges::fill(rays.geometry, RTC_INVALID_GEOMETRY_ID);
    const RTCRayHitNp stream{pointers_to(rays),
                             {rays.ng_x, rays.ng_y, rays.ng_z, rays.u, rays.v, rays.triangle, rays.geometry, {rays.instance}}};
    rtcIntersectNp(scene, &query.context, &stream, rays.count);
}
template <class Arrays>
void occluded_stream(RTCScene scene, RayQuery& query, Arrays& rays) {
    const RTCRayNp stream = pointers_to(rays);
    rtcOccludedNp(scene, &query.context, &stream, rays.count);
}

#endif

}  // namespace gnomon::reference
