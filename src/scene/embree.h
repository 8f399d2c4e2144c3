// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#if SLAMBENCH_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/// What differs between Embree 3 and 4, for packets of sixteen rays.
namespace slambench::embree {

/// The closest hits of rays that start together and run alike.
inline void intersect_coherent(const int* valid, RTCScene scene, RTCRayHit16* rays) {
#if SLAMBENCH_EMBREE_VERSION >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, rays);
#endif
}

/// Sets tfar to minus infinity for each ray that meets anything.
inline void occluded(const int* valid, RTCScene scene, RTCRay16* rays) {
#if SLAMBENCH_EMBREE_VERSION >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  rtcOccluded16(valid, scene, rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, scene, &context, rays);
#endif
}

}  // namespace slambench::embree
