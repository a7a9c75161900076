// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>

#include "core/vec.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// Moments of the area vectors a of a cluster of triangles over x, the position from `center`: what
/// it looks like from afar.
struct ClusterMoments {
  Vec3d center;
  double radius = 0;                ///< of a sphere around `center` that holds the triangles
  Vec3d area;                       ///< sum of a
  std::array<double, 6> first{};    ///< sum of x a, symmetric part: xx yy zz xy xz yz
  std::array<double, 10> second{};  ///< sum of x x a: xxx yyy zzz xxy xxz yyx yyz zzx zzy xyz
};

/// Winding numbers at up to `kMost` points at once, the loops over the points vectorized.
///
/// Solid angles of triangles are not added but multiplied: the triangle's angle is that of a
/// complex number (van Oosterom, Strackee: "The solid angle of a plane triangle", IEEE TBME 1983),
/// and one arc tangent of the product, with its full turns counted, does for all triangles.
class WindingLanes {
 public:
  static constexpr int kMost = 64;

  /// `points` stay the caller's; `count` <= kMost of them.
  WindingLanes(const Vec3d* points, int count);

  void add(const ClusterMoments& cluster);
  void add(const Corners& triangle);
  /// Writes the winding number at each point.
  void finish(double* result) const;

 private:
  using Lanes = std::array<double, kMost>;

  int count_;
  Lanes x_, y_, z_;
  Lanes far_, real_, imaginary_, turns_;
};

}  // namespace exemplar
