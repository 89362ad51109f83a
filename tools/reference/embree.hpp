// SPDX-License-Identifier: Apache-2.0
// Embree 3 or 4, whichever was found: what the two call differently.
#pragma once

#if GNOMON_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

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

#endif

}  // namespace gnomon::reference
