// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A point on a triangle of an example.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};  ///< barycentric, of the triangle's corners
  Vec3d position{};
  double distance = 0;  ///< from the point that was asked for
};

struct ClosestOptions {
  /// Triangles farther than this are not looked at, world units.
  double radius = std::numeric_limits<double>::infinity();
  /// A unit normal that the triangle's should have, and how many world units of distance the
  /// opposite normal costs: it tells the two sides of a thin wall apart.
  Vec3d facing{};
  double facingCost = 0;
  /// Only triangles t with groups[t] == group, where groups are given (one a triangle).
  std::span<const std::uint32_t> groups{};
  std::uint32_t group = 0;
};

/// Answers which point of a mesh is nearest (Embree's point queries over its triangles; distances
/// in double). Ties go to the triangle with the lowest index. Immutable: any number of threads may
/// ask. O(n log n) to make, about 200 bytes a triangle; O(log n) to ask, some microseconds.
class ExampleSurface {
 public:
  explicit ExampleSurface(const TriangleMesh& mesh);
  ~ExampleSurface();
  ExampleSurface(ExampleSurface&&) noexcept;
  ExampleSurface& operator=(ExampleSurface&&) noexcept;

  /// Nothing where no triangle lies within the radius.
  std::optional<SurfacePoint> closest(const Vec3d& point, const ClosestOptions& options = {}) const;

  /// Unit normal of a triangle; zero for one without area.
  const Vec3d& normal(std::uint32_t triangle) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace exemplar
