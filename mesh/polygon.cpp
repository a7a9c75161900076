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
/// the polygon runs anticlockwise. Relative to the first corner, for accuracy far from the origin.
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

void clipEars(const std::vector<Point>& p, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const std::uint32_t n = static_cast<std::uint32_t>(p.size());
  std::vector<std::uint32_t> next(n), previous(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    next[i] = (i + 1) % n;
    previous[i] = (i + n - 1) % n;
  }
  const auto isReflex = [&](std::uint32_t i) { return turn(p[previous[i]], p[i], p[next[i]]) < 0; };
  const auto isEar = [&](std::uint32_t i) {
    const Point &a = p[previous[i]], &b = p[i], &c = p[next[i]];
    if (turn(a, b, c) <= 0) return false;
    for (std::uint32_t j = next[next[i]]; j != previous[i]; j = next[j]) {
      const auto same = [&](const Point& q) { return p[j].x == q.x && p[j].y == q.y; };
      // Corners that touch the ear's own (a hole joined by a bridge) do not stand in its way.
      if (isReflex(j) && !same(a) && !same(b) && !same(c) && covers(a, b, c, p[j])) return false;
    }
    return true;
  };
  std::uint32_t i = 0, left = n, tried = 0;
  while (left > 3) {
    // After a whole round without an ear the polygon crosses itself or has no area: first a corner
    // without area goes, then any.
    const bool flat = tried >= left && turn(p[previous[i]], p[i], p[next[i]]) == 0;
    if (flat || tried >= 2 * left || (tried < left && isEar(i))) {
      triangles.push_back({previous[i], i, next[i]});
      next[previous[i]] = next[i];
      previous[next[i]] = previous[i];
      --left;
      tried = 0;
      // Going on two corners further keeps the triangles from forming one long fan.
      i = next[next[i]];
    } else {
      ++tried;
      i = next[i];
    }
  }
  triangles.push_back({previous[i], i, next[i]});
}

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
  clipEars(points, triangles);
  return true;
}

}  // namespace exemplar
