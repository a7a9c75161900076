// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "sdf/triangle_soup.h"

namespace exemplar {

/// What is inside a soup of triangles, however they face, by counting how often rays leave it
/// (Embree): a point is inside where most of 13 rays in directions spread over the sphere cross it
/// an odd number of times. A ray that grazes an edge, or leaves through a crack, is outvoted. Where
/// two solids overlap, rays count both: the overlap is outside.
class ParityTest {
 public:
  explicit ParityTest(const TriangleSoup& soup);
  ~ParityTest();

  /// Whether each point is inside. Any number of threads may ask.
  void inside(std::span<const Vec3d> points, std::span<std::uint8_t> result) const;

 private:
  bool inside(const Vec3d& p) const;

  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace exemplar
