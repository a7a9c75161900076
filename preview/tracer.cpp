// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/tracer.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>

namespace exemplar {
namespace {

template <class Packet>
void fill(Packet& packet, int* valid, const Rays& rays, const Lanes& live) {
  for (int k = 0; k < kLanes; ++k) {
    valid[k] = live[k] ? -1 : 0;
    packet.org_x[k] = rays[k].origin.x;
    packet.org_y[k] = rays[k].origin.y;
    packet.org_z[k] = rays[k].origin.z;
    packet.dir_x[k] = rays[k].direction.x;
    packet.dir_y[k] = rays[k].direction.y;
    packet.dir_z[k] = rays[k].direction.z;
    packet.tnear[k] = 0;
    packet.tfar[k] = live[k] ? kFar : -1;
    packet.time[k] = 0;
    packet.mask[k] = ~0u;
    packet.id[k] = 0;
    packet.flags[k] = 0;
  }
}

RTCIntersectContext contextFor(bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

bool any(const Lanes& lanes) {
  return std::any_of(lanes.begin(), lanes.end(), [](bool lane) { return lane; });
}

}  // namespace

void commitScene(RTCSceneTy* scene, const Progress& progress) {
  rtcSetSceneProgressMonitorFunction(
      scene,
      [](void* watched, double) { return !static_cast<const Progress*>(watched)->cancelled(); },
      const_cast<Progress*>(&progress));
  tbb::task_arena alone(1);
  alone.execute([&] { rtcJoinCommitScene(scene); });
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  progress.check();
}

SceneScale sceneScale(const Box3d& box, bool turnedOver) {
  const Vec3d size = box.size();
  const double side = std::max({size.x, size.y, size.z});
  return {box.min + size * 0.5, side > 1e-300 ? 2 / side : 1, turnedOver};
}

void Tracer::ReleaseDevice::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void Tracer::ReleaseScene::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

Tracer::Tracer(const TriangleMesh& mesh, const SceneScale& scale, const Progress& progress)
    : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("Embree: no device");
  scene_.reset(rtcNewScene(device_.get()));
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t n = mesh.positions.size(), m = mesh.triangles.size();
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), n));
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), m));
  if (!vertices || !triangles) {
    rtcReleaseGeometry(geometry);
    throw std::bad_alloc();
  }
  for (std::size_t v = 0; v < n; ++v) {
    const Vec3f p = cast<float>(scale(mesh.positions[v]));
    vertices[3 * v] = p.x, vertices[3 * v + 1] = p.y, vertices[3 * v + 2] = p.z;
  }
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  vertices_ = vertices;
  triangles_ = triangles;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);  // the scene holds it
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  commitScene(scene_.get(), progress);
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree: error " + std::to_string(error));
}

Hits Tracer::nearest(const Rays& rays, const Lanes& live, bool coherent) const {
  Hits hits{};
  if (!any(live)) return hits;
  RTCIntersectContext context = contextFor(coherent);
  RTCRayHit8 packet;
  alignas(32) int valid[kLanes];
  fill(packet.ray, valid, rays, live);
  for (int k = 0; k < kLanes; ++k)
    packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect8(valid, scene_.get(), &context, &packet);
  for (int k = 0; k < kLanes; ++k)
    if (live[k] && packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID)
      hits[k] = {true, packet.ray.tfar[k], packet.hit.u[k], packet.hit.v[k], packet.hit.primID[k]};
  return hits;
}

Lanes Tracer::open(const Rays& rays, const Lanes& live, bool coherent) const {
  Lanes open{};
  if (!any(live)) return open;
  RTCIntersectContext context = contextFor(coherent);
  RTCRay8 packet;
  alignas(32) int valid[kLanes];
  fill(packet, valid, rays, live);
  rtcOccluded8(valid, scene_.get(), &context, &packet);
  for (int k = 0; k < kLanes; ++k) open[k] = live[k] && packet.tfar[k] >= 0;
  return open;
}

}  // namespace exemplar
