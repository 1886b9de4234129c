// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Embree 3 or Embree 4, whichever the build has found.

#if MOLSURF_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <openvdb/Types.h>

#include <cstddef>

namespace molsurf
{

/// Sets ray k of a packet of 4 or 8; it meets all geometry (mask).
/// @param[in] way     unit
/// @param[in] length  how far it goes [Å]; may be infinite
template<typename Rays>
void setRay(Rays& rays, std::size_t k, const openvdb::Vec3d& from, const openvdb::Vec3d& way,
            double length)
{
    rays.org_x[k] = float(from[0]);
    rays.org_y[k] = float(from[1]);
    rays.org_z[k] = float(from[2]);
    rays.dir_x[k] = float(way[0]);
    rays.dir_y[k] = float(way[1]);
    rays.dir_z[k] = float(way[2]);
    rays.tnear[k] = 0.0f;
    rays.tfar[k] = float(length);
    rays.mask[k] = ~0u;
}

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
