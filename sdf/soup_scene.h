// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <new>

#include "sdf/triangle_soup.h"

namespace exemplar {

/// A soup's triangles as Embree sees them, with a device of their own; for sources of this room.
class SoupScene {
 public:
  /// O(n log n). Throws `std::bad_alloc`.
  SoupScene(const TriangleSoup& soup, RTCSceneFlags flags) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::bad_alloc();
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, flags);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               soup.points.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), soup.triangles.size()));
    if ((!points && !soup.points.empty()) || (!indices && !soup.triangles.empty())) {
      rtcReleaseGeometry(geometry);
      release();
      throw std::bad_alloc();
    }
    for (std::size_t p = 0; p < soup.points.size(); ++p)
      for (int axis = 0; axis < 3; ++axis)
        points[3 * p + axis] = static_cast<float>(soup.points[p][axis]);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      for (int c = 0; c < 3; ++c) indices[3 * t + c] = soup.triangles[t][c];
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  SoupScene(const SoupScene&) = delete;
  SoupScene& operator=(const SoupScene&) = delete;
  ~SoupScene() { release(); }

  RTCScene get() const { return scene_; }

 private:
  void release() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

}  // namespace exemplar
