// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/sloping_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/cells.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Ground that rises by more than this from one side to the other slopes, voxels.
constexpr double kSlope = 1;
/// The share of its length over which the height of a side is averaged.
constexpr double kSide = 1.0 / 8;

bool isGround(const DistanceField& example) {
  const Vec3i n = example.size();
  for (int j = 0; j < n.y; ++j) {
    for (int i = 0; i < n.x; ++i) {
      if (!(example.values(i, j, 0) < 0) || example.values(i, j, n.z - 1) < 0) return false;
    }
  }
  return true;
}

/// How much higher a ground is at one side than at the opposite one, along x or y, whichever is
/// more, voxels.
double slopeOf(const DistanceField& ground) {
  const Vec3i n = ground.size();
  double slope = 0;
  for (const int axis : {0, 1}) {
    const int reach = std::max(1, static_cast<int>(n[axis] * kSide));
    std::int64_t low = 0, high = 0;
    forEachCell(n, [&](const Vec3i& p) {
      if (!(ground.values[p] < 0)) return;
      low += p[axis] < reach;
      high += p[axis] >= n[axis] - reach;
    });
    const double columns = static_cast<double>(reach) * n[1 - axis];
    slope = std::max(slope, std::abs(static_cast<double>(high - low)) / columns);
  }
  return slope;
}

}  // namespace

bool isSlopingGround(const DistanceField& example) {
  return isGround(example) && slopeOf(example) > kSlope;
}

}  // namespace exemplar
