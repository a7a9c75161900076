// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/baked_light.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/parallel.h"
#include "core/random.h"
#include "preview/tracer.h"

namespace exemplar {
namespace {

constexpr double kLift = 1e-3;       // start of rays above the surface; the box's longest side is 2
constexpr double kFloorShare = 0.5;  // of the sky's light that the lit floor sends up
constexpr std::size_t kGrain = 512;  // probes

/// The mesh in Embree, its box about the origin with a longest side of two units.
class Occluder {
 public:
  Occluder(const TriangleMesh& mesh, const Progress& progress) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::bad_alloc();
    box_ = boundingBox(mesh);
    const Vec3d size = box_.size();
    const double side = std::max({size.x, size.y, size.z});
    scale_ = side > 1e-300 ? 2 / side : 1;
    scene_.reset(rtcNewScene(device_.get()));
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size()));
    auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (!vertices || !triangles) {
      rtcReleaseGeometry(geometry);
      throw std::bad_alloc();
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3d p = scaled(mesh.positions[v]);
      for (int axis = 0; axis < 3; ++axis) vertices[3 * v + axis] = static_cast<float>(p[axis]);
    }
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    commitScene(scene_.get(), progress);
  }

  Vec3d scaled(const Vec3d& p) const { return (p - box_.center()) * scale_; }
  double floor() const { return (box_.min.z - box_.center().z) * scale_ - 1e-3; }

  bool open(const Vec3d& from, const Vec3d& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tfar = 1e6f;
    ray.mask = ~0u;
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar >= 0;
  }

 private:
  struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
  Box3d box_;
  double scale_ = 1;
};

/// Two unit vectors perpendicular to `n` and to each other.
std::array<Vec3d, 2> across(const Vec3d& n) {
  const Vec3d other = std::abs(n.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  const Vec3d u = normalized(cross(other, n));
  return {u, cross(n, u)};
}

/// The i-th of n well-spread points of the unit square, moved by `shift`: a rank-one lattice by the
/// plastic number's powers.
std::array<double, 2> latticePoint(int i, const std::array<double, 2>& shift) {
  const auto fraction = [](double v) { return v - std::floor(v); };
  return {fraction(shift[0] + i * 0.7548776662466927), fraction(shift[1] + i * 0.5698402909980532)};
}

std::uint8_t byteOf(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

Vec3d keyDirection(const RenderOptions& picture) {
  // Behind the camera, turned to its left.
  const double a = picture.view.azimuth - picture.keyAzimuth, e = picture.keyElevation;
  return {std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e)};
}

std::vector<BakedLight> bakeLight(const TriangleMesh& mesh, std::span<const LightProbe> probes,
                                  const BakeOptions& options, const Progress& progress) {
  for (const int rays : {options.rays, options.keyRays})
    if (rays < 1 || rays > 4096)
      throw InputError("baked light: " + std::to_string(rays) +
                       " rays a point are out of range; 1..4096 is right");
  validate(mesh, "baked light");
  progress.report("gathering light", 0);
  const Occluder occluder(mesh, progress);
  const Vec3d key = keyDirection(options.picture);
  const std::array<Vec3d, 2> besideKey = across(key);
  const double floor = options.picture.ground ? occluder.floor() : -1e300;
  std::vector<BakedLight> light(probes.size());
  LoopProgress gathered(progress, "gathering light", probes.size());
  parallelFor(0, probes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const Random random(options.seed, stream::kBakedLight);
    for (std::size_t p = begin; p < end; ++p) {
      gathered.check();
      Vec3d n = normalized(cast<double>(probes[p].normal));
      if (n == Vec3d{}) n = {0, 0, 1};
      const Vec3d from = occluder.scaled(probes[p].position) + n * kLift;
      const auto [u, v] = across(n);
      std::array<double, 2> shift{random.uniform(p, 0), random.uniform(p, 1)};
      double sky = 0;
      for (int i = 0; i < options.rays; ++i) {
        const auto [x, y] = latticePoint(i, shift);
        const double r = std::sqrt(x), phi = 2 * std::numbers::pi * y;
        const Vec3d to = u * (r * std::cos(phi)) + v * (r * std::sin(phi)) + n * std::sqrt(1 - x);
        if (!occluder.open(from, to)) continue;
        sky += to.z < 0 && floor > -1e200 ? kFloorShare : 1;
      }
      light[p].sky = byteOf(sky / options.rays);
      if (dot(n, key) <= 0) {
        light[p].key = 0;
        continue;
      }
      shift = {random.uniform(p, 2), random.uniform(p, 3)};
      int lit = 0;
      for (int i = 0; i < options.keyRays; ++i) {
        const auto [x, y] = latticePoint(i, shift);
        const double r = std::tan(options.picture.keyRadius) * std::sqrt(x);
        const double phi = 2 * std::numbers::pi * y;
        lit += occluder.open(from, normalized(key + besideKey[0] * (r * std::cos(phi)) +
                                              besideKey[1] * (r * std::sin(phi))));
      }
      light[p].key = byteOf(static_cast<double>(lit) / options.keyRays);
    }
    gathered.advance(end - begin);
  });
  return light;
}

}  // namespace exemplar
