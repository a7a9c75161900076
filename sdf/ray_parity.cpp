// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/ray_parity.h"

#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <numbers>

namespace exemplar {
namespace {

constexpr int kRays = 13;

// Directions spread evenly, none of them along an axis or a diagonal, where meshes have their
// edges: points of a Fibonacci lattice, turned by an arbitrary angle.
std::array<Vec3f, kRays> makeDirections() {
  std::array<Vec3f, kRays> directions;
  for (int r = 0; r < kRays; ++r) {
    const double z = 1 - (2 * r + 1.0) / kRays;
    const double angle = 0.7391 + r * std::numbers::pi * (3 - std::sqrt(5.0));
    const double s = std::sqrt(1 - z * z);
    directions[r] = cast<float>(Vec3d{s * std::cos(angle), s * std::sin(angle), z});
  }
  return directions;
}

struct CountingContext {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to this
  unsigned hits;
};

// Counts a hit and refuses it, so that the ray continues.
void count(const RTCFilterFunctionNArguments* arguments) {
  ++reinterpret_cast<CountingContext*>(arguments->context)->hits;
  arguments->valid[0] = 0;
}

}  // namespace

struct ParityTest::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::array<Vec3f, kRays> directions = makeDirections();

  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

ParityTest::ParityTest(const TriangleSoup& soup) : scene_(std::make_unique<Scene>()) {
  Scene& s = *scene_;
  s.device = rtcNewDevice(nullptr);
  if (!s.device) throw std::bad_alloc();
  s.scene = rtcNewScene(s.device);
  // Robust: no ray slips between two triangles at their edge.
  rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             soup.points.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), soup.triangles.size()));
  if ((!points && !soup.points.empty()) || (!indices && !soup.triangles.empty())) {
    rtcReleaseGeometry(geometry);
    throw std::bad_alloc();
  }
  for (std::size_t p = 0; p < soup.points.size(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      points[3 * p + axis] = static_cast<float>(soup.points[p][axis]);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) indices[3 * t + c] = soup.triangles[t][c];
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(s.scene);
}

ParityTest::~ParityTest() = default;

bool ParityTest::inside(const Vec3d& p) const {
  int votes = 0;
  for (const Vec3f& direction : scene_->directions) {
    CountingContext counting;
    rtcInitIntersectContext(&counting.context);
    counting.context.filter = count;
    counting.hits = 0;
    RTCRay ray{};
    ray.org_x = static_cast<float>(p.x);
    ray.org_y = static_cast<float>(p.y);
    ray.org_z = static_cast<float>(p.z);
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = 0xffffffff;
    rtcOccluded1(scene_->scene, &counting.context, &ray);
    votes += static_cast<int>(counting.hits & 1);
  }
  return 2 * votes > kRays;
}

void ParityTest::inside(std::span<const Vec3d> points, std::span<std::uint8_t> result) const {
  for (std::size_t p = 0; p < points.size(); ++p) result[p] = inside(points[p]);
}

}  // namespace exemplar
