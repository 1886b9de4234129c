// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Embree 3 or Embree 4, whichever the build has found.

#if MOLSURF_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace molsurf
{

/// Finds the first hit of each ray that is valid (-1); the rays go much the same way.
inline void intersect(const int* valid, RTCScene scene, RTCRayHit4& rays)
{
#if MOLSURF_EMBREE == 3
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect4(valid, scene, &context, &rays);
#else
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect4(valid, scene, &rays, &arguments);
#endif
}

/// Sets tfar of each ray that is valid (-1) to minus infinity if it meets anything.
inline void occlude(const int* valid, RTCScene scene, RTCRay4& rays)
{
#if MOLSURF_EMBREE == 3
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded4(valid, scene, &context, &rays);
#else
    rtcOccluded4(valid, scene, &rays);
#endif
}
inline void occlude(const int* valid, RTCScene scene, RTCRay8& rays)
{
#if MOLSURF_EMBREE == 3
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded8(valid, scene, &context, &rays);
#else
    rtcOccluded8(valid, scene, &rays);
#endif
}

} // namespace molsurf
