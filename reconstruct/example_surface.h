// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/triangle_tree.h"

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

/// Finds the nearest point of a mesh, by a `TriangleTree`. Ties go to the triangle with the lowest
/// index. Immutable: any number of threads may ask. O(n log n) to build, about 220 bytes a
/// triangle; O(log n) to ask, some microseconds.
class ExampleSurface {
 public:
  /// Throws `Cancelled`, and `InputError` where the mesh would not fit in memory.
  explicit ExampleSurface(const TriangleMesh& mesh, const Progress& progress = {});

  /// Nothing where no triangle lies within the radius.
  std::optional<SurfacePoint> closest(const Vec3d& point, const ClosestOptions& options = {}) const;

  /// Unit normal of a triangle; zero for one without area.
  const Vec3d& normal(std::uint32_t triangle) const { return normals_[triangle]; }

 private:
  TriangleTree tree_;
  std::vector<Vec3d> normals_;
  double meanSide_ = 0;  // of the triangles
};

}  // namespace exemplar
