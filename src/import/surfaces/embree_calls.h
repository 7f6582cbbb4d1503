// Embree's functions, as its module passes them.
#pragma once

#if OMBRE_EMBREE_VERSION == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace ombre::importing {

struct EmbreeCalls {
  decltype(&rtcNewDevice) new_device = rtcNewDevice;
  decltype(&rtcReleaseDevice) release_device = rtcReleaseDevice;
  decltype(&rtcGetDeviceError) get_device_error = rtcGetDeviceError;
  decltype(&rtcNewScene) new_scene = rtcNewScene;
  decltype(&rtcReleaseScene) release_scene = rtcReleaseScene;
  decltype(&rtcSetSceneFlags) set_scene_flags = rtcSetSceneFlags;
  decltype(&rtcCommitScene) commit_scene = rtcCommitScene;
  decltype(&rtcNewGeometry) new_geometry = rtcNewGeometry;
  decltype(&rtcReleaseGeometry) release_geometry = rtcReleaseGeometry;
  decltype(&rtcSetGeometryUserPrimitiveCount) set_primitive_count = rtcSetGeometryUserPrimitiveCount;
  decltype(&rtcSetGeometryUserData) set_user_data = rtcSetGeometryUserData;
  decltype(&rtcSetGeometryBoundsFunction) set_bounds = rtcSetGeometryBoundsFunction;
  decltype(&rtcCommitGeometry) commit_geometry = rtcCommitGeometry;
  decltype(&rtcAttachGeometry) attach_geometry = rtcAttachGeometry;
  decltype(&rtcPointQuery) point_query = rtcPointQuery;
};

}  // namespace ombre::importing

extern "C" const ombre::importing::EmbreeCalls* ombre_embree_calls();
