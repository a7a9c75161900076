// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/row_crossing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "mesh/predicates.h"

namespace exemplar {
namespace {

int signOf(double x) { return (x > 0) - (x < 0); }

// On which side of the line from a to b, seen along x, (y, z) lies: 1 left, -1 right. The same
// numbers whichever way the edge runs.
int sideOf(const Vec3d& a, const Vec3d& b, double y, double z) {
  const bool swapped = b.y != a.y ? b.y < a.y : b.z != a.z ? b.z < a.z : b.x < a.x;
  const Vec3d &p = swapped ? b : a, &q = swapped ? a : b;
  const int way = swapped ? -1 : 1;
  const double left = (q.y - p.y) * (z - p.z), right = (q.z - p.z) * (y - p.y);
  const double determinant = left - right;
  constexpr double kEpsilon = 0x1p-53;
  constexpr double kBound = (3 + 16 * kEpsilon) * kEpsilon;  // Shewchuk's ccwerrboundA
  int side = signOf(determinant);
  if (std::abs(determinant) <= kBound * (std::abs(left) + std::abs(right))) {
    // The exact one is that of a tetrahedron over the three points in the plane x = 0.
    side = left == 0 && right == 0
               ? 0
               : orientation({0, p.y, p.z}, {0, q.y, q.z}, {0, y, z}, {1, y, z});
  }
  if (side == 0) side = q.z != p.z ? (q.z > p.z ? -1 : 1) : (q.y != p.y ? (q.y > p.y ? 1 : -1) : 1);
  return way * side;
}

// Whether a point of the row before `x` sees the triangle, which crosses the row in direction
// `way`, ahead: on the side of its plane that the row comes from.
bool isBeyond(const Corners& t, int way, const Vec3d& p) {
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  return way * dot(normal, p - t[0]) < 0;
}

// Where the row crosses the triangle's plane.
double placeOf(const Corners& t, double y, double z) {
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  return t[0].x - (normal.y * (y - t[0].y) + normal.z * (z - t[0].z)) / normal.x;
}

}  // namespace

int crossesRow(const Corners& t, double y, double z) {
  const int first = sideOf(t[0], t[1], y, z);
  if (sideOf(t[1], t[2], y, z) != first || sideOf(t[2], t[0], y, z) != first) return 0;
  return first;
}

int windingAlongRow(const TriangleTree& tree, const Vec3d& p) {
  int winding = 0;
  tree.visitRow(p, [&](const Corners& t) {
    const int way = crossesRow(t, p.y, p.z);
    if (way != 0 && isBeyond(t, way, p)) winding += way;
  });
  return winding;
}

void markInside(const TriangleTree& tree, const Vec3i& low, Array3D<std::uint8_t>& inside,
                const Progress& progress) {
  const Vec3i size = inside.size();
  const Vec3d first = cast<double>(low), last = cast<double>(low + size - Vec3i{1, 1, 1});
  if (tree.count() == 0) return;
  LoopProgress layers(progress, "finding signs", static_cast<std::size_t>(size.z));
  parallelFor(0, static_cast<std::size_t>(size.z), 1, [&](std::size_t k0, std::size_t k1) {
    // By how much the winding number is higher before a sample than at it.
    std::vector<std::int32_t> steps;
    const auto width = static_cast<std::size_t>(size.x) + 1;
    for (auto k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      steps.assign(width * static_cast<std::size_t>(size.y), 0);
      const double z = low.z + k;
      tree.visitBox({first.x, first.y, z}, {std::numeric_limits<double>::infinity(), last.y, z},
                    [&](std::uint32_t n) {
                      const Corners& t = tree.triangle(n);
                      const double yLow = std::min({t[0].y, t[1].y, t[2].y}),
                                   yHigh = std::max({t[0].y, t[1].y, t[2].y});
                      const double j0 = std::max(std::ceil(yLow), first.y),
                                   j1 = std::min(std::floor(yHigh), last.y);
                      for (double y = j0; y <= j1; ++y) {
                        const int way = crossesRow(t, y, z);
                        if (way == 0) continue;
                        const double x = placeOf(t, y, z) - first.x;
                        // Samples before it see it: those up to, not including, the first beyond.
                        const double end = std::clamp(std::ceil(x), 0.0, double(size.x));
                        steps[width * static_cast<std::size_t>(y - first.y) +
                              static_cast<std::size_t>(end)] += way;
                      }
                    });
      for (int j = 0; j < size.y; ++j) {
        std::int32_t winding = 0;
        for (int i = size.x - 1; i >= 0; --i) {
          winding += steps[width * static_cast<std::size_t>(j) + static_cast<std::size_t>(i) + 1];
          if (winding != 0) inside(i, j, k) = 1;
        }
      }
      layers.advance();
    }
  });
}

}  // namespace exemplar
