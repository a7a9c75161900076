// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/exact.h"

#include <algorithm>
#include <cstdlib>

namespace exemplar::continuous {

bool meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c, ExactPoint& point) {
  const Vec3l bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal),
              ab = cross(a.normal, b.normal);
  std::int64_t d = dot(a.normal, bc);
  if (d == 0) return false;
  Vec3l n = a.offset * bc + b.offset * ca + c.offset * ab;
  if (d < 0) {
    d = -d;
    n = -n;
  }
  const std::int64_t g = std::gcd(d, gcd(n));
  d /= g;
  n = n / g;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(n[axis]) > kMostCoordinate * d) return false;
  if (d > kMostDenominator) return false;
  point = {n, d};
  return true;
}

int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const Vec3l& normal) {
  // Dropping an axis along which the normal is not 0 keeps who is where.
  const Vec3l size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  const Vec3l ab = b.n * a.d - a.n * b.d, ac = c.n * a.d - a.n * c.d;
  const Wide twice = Wide{ab[u]} * ac[v] - Wide{ab[v]} * ac[u];
  const int s = twice > 0 ? 1 : twice < 0 ? -1 : 0;
  return normal[drop] < 0 ? -s : s;
}

void makeDistinct(std::vector<ExactPoint>& points) {
  std::ranges::sort(points, [](const ExactPoint& a, const ExactPoint& b) { return before(a, b); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

void makeDistinct(std::vector<ExactPlane>& planes) {
  std::ranges::sort(planes, [](const ExactPlane& a, const ExactPlane& b) { return before(a, b); });
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
}

}  // namespace exemplar::continuous
