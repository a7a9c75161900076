// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/triangle_mesh.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace exemplar {

inline constexpr int kLanes = 8;     ///< rays traced together
inline constexpr float kFar = 1e6f;  ///< scene units, see `SceneScale`

/// From the world to the scene that is traced: the mesh's box about the origin, its longest side
/// two units, so that single precision serves whatever the coordinates. Views from below are traced
/// turned over, with light from "above".
struct SceneScale {
  Vec3d center;
  double factor = 1;
  bool turnedOver = false;

  Vec3d operator()(const Vec3d& p) const {
    const Vec3d q = (p - center) * factor;
    return turnedOver ? turn(q) : q;
  }
  template <class T>
  static Vec3<T> turn(const Vec3<T>& v) {
    return {v.x, v.y, -v.z};
  }
};

/// Builds a scene's tree by one thread: with more, the order of triangles within its leaves would
/// depend on their number, and with it which of two coinciding triangles a ray reports. Throws
/// `Cancelled`.
void commitScene(RTCSceneTy* scene, const Progress& progress);

/// For a mesh in `box`.
SceneScale sceneScale(const Box3d& box, bool turnedOver);

/// What a ray meets; its place is (1 - u - v, u, v) of the triangle.
struct Hit {
  bool mesh = false;
  float distance = kFar, u = 0, v = 0;
  std::uint32_t triangle = 0;
};

struct Ray {
  Vec3f origin, direction;
};

using Lanes = std::array<bool, kLanes>;
using Rays = std::array<Ray, kLanes>;
using Hits = std::array<Hit, kLanes>;

/// Rays against a mesh (Embree). The same answers at any number of threads, on one kind of machine.
class Tracer {
 public:
  /// Throws `Cancelled`.
  Tracer(const TriangleMesh& mesh, const SceneScale& scale, const Progress& progress = {});

  /// Nearest hits of the rays in `live` lanes. `coherent`: the rays run much alike (a hint).
  Hits nearest(const Rays& rays, const Lanes& live, bool coherent) const;
  /// Which of the rays in `live` lanes meet nothing.
  Lanes open(const Rays& rays, const Lanes& live, bool coherent) const;

  std::array<Vec3f, 3> corners(std::uint32_t triangle) const {
    const auto& t = triangles_[triangle];
    return {vertex(t[0]), vertex(t[1]), vertex(t[2])};
  }

 private:
  struct ReleaseDevice {
    void operator()(RTCDeviceTy* device) const;
  };
  struct ReleaseScene {
    void operator()(RTCSceneTy* scene) const;
  };

  Vec3f vertex(std::uint32_t v) const {
    const float* p = vertices_ + 3 * static_cast<std::size_t>(v);
    return {p[0], p[1], p[2]};
  }

  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
  const float* vertices_ = nullptr;
  const std::array<std::uint32_t, 3>* triangles_ = nullptr;
};

}  // namespace exemplar
