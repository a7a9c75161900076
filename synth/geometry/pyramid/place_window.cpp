// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/pyramid/place_window.h"

#include <algorithm>
#include <cmath>

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// How far parts of an object that keeps its size may move along it, of its length.
constexpr double kObjectShift = 0.16;
/// How far patches may be from their place, of the example's length: a quarter of by how much the
/// result is longer or shorter, within these limits.
constexpr double kShareOfStretch = 1.0 / 4, kLeastShift = 1.0 / 32, kMostShift = 1.0 / 4;

}  // namespace

int placeWindow(const PyramidLevel& level, int axis) {
  const double source = level.source.parts[0].size()[axis];
  const double stretch = std::abs(level.target.size[axis] / source - 1);
  return std::max(
      1, static_cast<int>(source * std::clamp(stretch * kShareOfStretch, kLeastShift, kMostShift)));
}

Vec3i blockWindow(const PyramidLevel& level, const Axes& stationary, const Axes& inPlace) {
  const Margin& air = level.source.air;
  const Vec3i n = level.source.parts[0].size();
  const int longest = std::max({n.x, n.y, n.z});
  Vec3i window;
  for (int axis = 0; axis < 3; ++axis) {
    const bool object = air.before[axis] > 0 && air.after[axis] > 0;
    // Air above, say, and below what the box cuts off: parts that moved would lose their ground.
    const bool rests = (air.before[axis] > 0) != (air.after[axis] > 0);
    const bool keepsSize = level.target.size[axis] == n[axis];
    if ((rests || inPlace[axis]) && keepsSize) {
      window[axis] = 0;
    } else if (object && keepsSize) {
      const bool thin = 2 * n[axis] < longest;
      window[axis] = thin ? 0 : static_cast<int>(std::lround(n[axis] * kObjectShift));
    } else {
      window[axis] = stationary[axis] ? -1 : placeWindow(level, axis);
    }
  }
  return window;
}

Vec3i patchWindow(const PyramidLevel& level, const Axes& stationary, const Axes& inPlace) {
  Vec3i window = blockWindow(level, stationary, inPlace);
  for (int axis = 0; axis < 3; ++axis) {
    if (window[axis] < 0) continue;
    const double n = level.source.parts[0].size()[axis];
    const double stretch = std::abs(1 - n / level.target.size[axis]);
    window[axis] += 1 + static_cast<int>(std::ceil(stretch * n / 2));
  }
  return window;
}

}  // namespace exemplar
