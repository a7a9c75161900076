// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>

#include "core/vec.h"

namespace exemplar {

/// The corners of a triangle.
using Corners = std::array<Vec3d, 3>;

/// The point of a triangle that is nearest to another point.
struct ClosestPoint {
  std::array<double, 3> weights;  ///< barycentric, >= 0 but for rounding, summing to 1
  Vec3d offset;                   ///< from it to the point that was asked for
};

/// Returns `use(weights, offset)` for the point of triangle `t` that is nearest to `p`, with what
/// `ClosestPoint` holds; what `use` ignores is not computed.
///
/// Exact but for rounding, also where corners coincide (Ericson: "Real-Time Collision Detection",
/// 2005, section 5.1.5: which of the triangle's seven Voronoi regions holds the point).
template <class Use>
auto atClosestPoint(const Vec3d& p, const Corners& t, const Use& use) {
  using Weights = std::array<double, 3>;
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return use(Weights{1, 0, 0}, ap);
  const Vec3d bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return use(Weights{0, 1, 0}, bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    if (d1 - d3 > 0) {
      const double share = d1 / (d1 - d3);
      return use(Weights{1 - share, share, 0}, ap - ab * share);
    }
    // The first two corners are one, or too near to each other for rounding at this distance.
    const double length2 = dot(ac, ac);
    if (!(ab == Vec3d{})) return use(Weights{1, 0, 0}, ap);
    if (d2 >= length2) return use(Weights{0, 0, 1}, p - t[2]);
    return use(Weights{1 - d2 / length2, 0, d2 / length2}, ap - ac * (d2 / length2));
  }
  const Vec3d cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return use(Weights{0, 0, 1}, cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double share = d2 - d6 > 0 ? d2 / (d2 - d6) : 0;
    return use(Weights{1 - share, 0, share}, ap - ac * share);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double length = (d4 - d3) + (d5 - d6);
    const double share = length > 0 ? (d4 - d3) / length : 0;
    return use(Weights{0, 1 - share, share}, bp - (t[2] - t[1]) * share);
  }
  const double sum = va + vb + vc;
  return use(Weights{va / sum, vb / sum, vc / sum}, ap - ab * (vb / sum) - ac * (vc / sum));
}

/// The point of triangle `t` that is nearest to `p`.
inline ClosestPoint closestPoint(const Vec3d& p, const Corners& t) {
  return atClosestPoint(p, t, [](const std::array<double, 3>& weights, const Vec3d& offset) {
    return ClosestPoint{weights, offset};
  });
}

/// The squared distance of `p` from a triangle.
inline double squaredDistance(const Vec3d& p, const Corners& triangle) {
  return atClosestPoint(p, triangle, [](const std::array<double, 3>&, const Vec3d& offset) {
    return dot(offset, offset);
  });
}

}  // namespace exemplar
