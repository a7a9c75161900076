// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "core/progress.h"
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
  /// Triangles farther away than this do not count, world units.
  double radius = std::numeric_limits<double>::infinity();
  /// A unit normal that the triangle's should have, and how many world units of distance the
  /// opposite normal costs: it distinguishes the two sides of a thin wall.
  Vec3d facing{};
  double facingCost = 0;
  /// Only triangles t with groups[t] == group, where groups are given (one per triangle).
  std::span<const std::uint32_t> groups{};
  std::uint32_t group = 0;
};

/// Finds which point of a mesh is nearest, by Embree's point queries over its triangles with
/// `closestPoint` in double. Unlike `TriangleTree` it weighs which way triangles face, and is built
/// and asked faster near the surface; its bounds are floats, so that of triangles whose distances
/// agree to the last digits of a float any may be returned. Ties go to the triangle with the lowest
/// index. Immutable: any number of threads may ask. O(n log n) to build, about 200 bytes a
/// triangle; O(log n) to ask, some microseconds.
class ExampleSurface {
 public:
  /// Throws `Cancelled`, and `InputError` where the mesh would not fit in memory.
  explicit ExampleSurface(const TriangleMesh& mesh, const Progress& progress = {});
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
