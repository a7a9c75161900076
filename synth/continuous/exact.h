// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "core/vec.h"

/// Exact arithmetic of continuous model synthesis: integer normals, rational points.
///
/// Ranges. A normal's components are at most 64 in size, so that the determinant of three normals
/// is at most (64 sqrt(3))^3 < 2^21 (Hadamard) and the cross product of two at most 2^13. Points
/// lie within 2^17 units of the origin of the grid, so that offsets of planes are below 3 * 64 *
/// 2^17 < 2^25, and a point n / d has d < 2^21 and |n| <= 2^17 d < 2^38. Then
///   - n . N and c d are below 3 * 2^6 * 2^38 < 2^46: the side of a plane fits in 64 bits;
///   - a difference of two points over their common denominator is below 2^60, the product of two
///     of these below 2^120: the turn of three points of a plane fits in 128 bits;
///   - comparing coordinates of two points takes 2^38 * 2^21 = 2^59: 64 bits.
namespace exemplar::continuous {

using Vec3l = Vec3<std::int64_t>;
__extension__ typedef __int128 Wide;

inline constexpr int kMostNormal = 64;                           ///< of a normal's components
inline constexpr std::int64_t kMostCoordinate = 1 << 17;         ///< of points, units of the grid
inline constexpr std::int64_t kMostDenominator = (1 << 21) - 1;  ///< of points
inline constexpr int kMostFamilies = 32;  ///< directions of planes, so that a set of them is a word

constexpr int sign(std::int64_t a) { return a > 0 ? 1 : a < 0 ? -1 : 0; }
inline std::int64_t gcd(const Vec3l& v) { return std::gcd(v.x, std::gcd(v.y, v.z)); }

/// The shortest integer vector of a direction; `v` is not 0.
inline Vec3l primitive(const Vec3l& v) { return v / gcd(v); }
/// Whether the first component that is not 0 is positive.
constexpr bool isCanonical(const Vec3l& v) {
  return v.x != 0 ? v.x > 0 : v.y != 0 ? v.y > 0 : v.z > 0;
}
/// Of the two primitive vectors along a line the canonical one.
inline Vec3l canonical(const Vec3l& v) {
  const Vec3l p = primitive(v);
  return isCanonical(p) ? p : -p;
}
/// A total order of vectors.
constexpr bool before(const Vec3l& a, const Vec3l& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}
constexpr std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return q * b > a ? q - 1 : q;
}
constexpr std::int64_t determinant(const Vec3l& a, const Vec3l& b, const Vec3l& c) {
  return dot(a, cross(b, c));
}

/// A rational point n / d: d > 0, reduced.
struct ExactPoint {
  Vec3l n;
  std::int64_t d = 1;

  bool operator==(const ExactPoint&) const = default;
  Vec3d approximately() const { return cast<double>(n) / static_cast<double>(d); }
};
/// Lexicographic order, by x, y, z.
inline bool before(const ExactPoint& a, const ExactPoint& b) {
  if (a.d == b.d) return before(a.n, b.n);
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t l = a.n[axis] * b.d, r = b.n[axis] * a.d;
    if (l != r) return l < r;
  }
  return false;
}

/// The plane normal . x = offset.
struct ExactPlane {
  Vec3l normal;
  std::int64_t offset = 0;

  bool operator==(const ExactPlane&) const = default;
  /// The side of it that a point is on: 1 where normal . x is above the offset.
  int side(const ExactPoint& p) const { return sign(dot(normal, p.n) - offset * p.d); }
};
inline bool before(const ExactPlane& a, const ExactPlane& b) {
  return a.normal == b.normal ? a.offset < b.offset : before(a.normal, b.normal);
}
/// The same plane with a canonical normal.
inline ExactPlane canonical(const ExactPlane& plane) {
  return isCanonical(plane.normal) ? plane : ExactPlane{-plane.normal, -plane.offset};
}

/// Where three planes meet; false where that is no point or one out of range.
bool meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c, ExactPoint& point);

/// The sign of the turn a, b, c (points of one plane), seen from the tip of its normal: 1 to the
/// left.
int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const Vec3l& normal);

/// Sorts, and leaves out what is equal.
void makeDistinct(std::vector<ExactPoint>& points);
void makeDistinct(std::vector<ExactPlane>& planes);

}  // namespace exemplar::continuous
