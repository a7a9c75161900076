// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/polygon.h"

#include <cassert>

namespace exemplar {
namespace {

struct Point {
  double x, y;
};

/// Twice the signed area of a triangle in the plane: positive where it turns to the left.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether `p` lies in the triangle or on its border.
bool covers(const Point& a, const Point& b, const Point& c, const Point& p) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// The corners in the plane across the polygon's mean normal (Newell's), seen from its tip, so that
/// the polygon runs counterclockwise. Relative to the first corner, for accuracy far from the
/// origin.
std::vector<Point> project(std::span<const Vec3d> corners) {
  Vec3d normal;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  // Dropping the axis along which the normal is longest stretches the plane but keeps who is where.
  const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  const double sign = normal[drop] < 0 ? -1 : 1;
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const Vec3d& c : corners)
    points.push_back({c[u] - corners[0][u], sign * (c[v] - corners[0][v])});
  return points;
}

bool isConvex(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  // Turning left everywhere is not enough: a star does too. Along the first axis a convex polygon
  // changes direction twice.
  int changes = 0, direction = 0, first = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
    const double step = p[(i + 1) % n].x - p[i].x;
    const int d = step > 0 ? 1 : step < 0 ? -1 : 0;
    if (d == 0) continue;
    if (direction == 0) first = d;
    if (direction != 0 && d != direction) ++changes;
    direction = d;
  }
  if (direction != first) ++changes;
  return changes <= 2;
}

/// Clips ears in time that grows with the square of the number of corners: clipping one changes
/// only what its two neighbors are (D. Eberly: "Triangulation by ear clipping", Geometric Tools,
/// 2002).
class EarClipper {
 public:
  EarClipper(const std::vector<Point>& points, std::vector<std::array<std::uint32_t, 3>>& triangles)
      : p_(points),
        triangles_(triangles),
        next_(points.size()),
        previous_(points.size()),
        isReflex_(points.size()),
        isEar_(points.size()) {}

  void clip() {
    const std::uint32_t n = static_cast<std::uint32_t>(p_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    for (std::uint32_t i = 0; i < n; ++i) isReflex_[i] = turnAt(i) < 0;
    for (std::uint32_t i = 0; i < n; ++i) isEar_[i] = findsEar(i);
    std::uint32_t i = 0;
    for (std::uint32_t left = n; left > 3; --left) {
      i = chooseCorner(i, left);
      triangles_.push_back({previous_[i], i, next_[i]});
      const std::uint32_t before = previous_[i], after = next_[i];
      next_[before] = after;
      previous_[after] = before;
      for (const std::uint32_t c : {before, after}) isReflex_[c] = turnAt(c) < 0;
      for (const std::uint32_t c : {before, after}) isEar_[c] = findsEar(c);
      // Going on two corners further keeps the triangles from forming one long fan.
      i = next_[after];
    }
    triangles_.push_back({previous_[i], i, next_[i]});
  }

 private:
  double turnAt(std::uint32_t i) const { return turn(p_[previous_[i]], p_[i], p_[next_[i]]); }

  bool findsEar(std::uint32_t i) const {
    const Point &a = p_[previous_[i]], &b = p_[i], &c = p_[next_[i]];
    if (turn(a, b, c) <= 0) return false;
    for (std::uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
      if (!isReflex_[j] || !covers(a, b, c, p_[j])) continue;
      // Corners that touch the ear's own (a hole joined by a bridge) do not block it.
      const auto same = [&](const Point& q) { return p_[j].x == q.x && p_[j].y == q.y; };
      if (!same(a) && !same(b) && !same(c)) return false;
    }
    return true;
  }

  /// The next ear from `i` on. Where there is none the polygon crosses itself or has no area: then
  /// a corner without area, or else `i`.
  std::uint32_t chooseCorner(std::uint32_t i, std::uint32_t left) const {
    std::uint32_t flat = i;
    bool hasFlat = false;
    for (std::uint32_t k = 0; k < left; ++k, i = next_[i]) {
      if (isEar_[i]) return i;
      if (!hasFlat && turnAt(i) == 0) {
        flat = i;
        hasFlat = true;
      }
    }
    return flat;
  }

  const std::vector<Point>& p_;
  std::vector<std::array<std::uint32_t, 3>>& triangles_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<char> isReflex_, isEar_;
};

}  // namespace

bool triangulate(std::span<const Vec3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  assert(corners.size() >= 3);
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});
    return true;
  }
  const std::vector<Point> points = project(corners);
  if (isConvex(points)) {
    for (std::uint32_t i = 2; i < corners.size(); ++i) triangles.push_back({0, i - 1, i});
    return true;
  }
  if (corners.size() > kMostCorners) return false;
  EarClipper(points, triangles).clip();
  return true;
}

}  // namespace exemplar
