// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/stationary.h"

#include <algorithm>

#include "core/cells.h"

namespace exemplar {
namespace {

/// Quarters of an axis may differ in occupancy by this share of what the example has of solid or of
/// air, whichever is less, and by this much besides.
constexpr double kDifference = 0.5, kLeastDifference = 0.02;

}  // namespace

Axes findStationaryAxes(const DistanceField& example, const Array3D<std::uint8_t>* known) {
  const Vec3i n = example.size();
  double occupied[3][4] = {}, count[3][4] = {};
  forEachCell(n, [&](const Vec3i& p) {
    if (known && !(known->contains(p) && (*known)[p])) return;
    const bool solid = example.values[p] < 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int part = p[axis] * 4 / n[axis];
      occupied[axis][part] += solid;
      count[axis][part] += 1;
    }
  });
  Axes axes;
  for (int axis = 0; axis < 3; ++axis) {
    double low = 1, high = 0, solid = 0, all = 0;
    for (int part = 0; part < 4; ++part) {
      solid += occupied[axis][part];
      all += count[axis][part];
      if (count[axis][part] == 0) continue;
      low = std::min(low, occupied[axis][part] / count[axis][part]);
      high = std::max(high, occupied[axis][part] / count[axis][part]);
    }
    const double mean = solid / std::max(1.0, all);
    axes[axis] = high - low <= kDifference * std::min(mean, 1 - mean) + kLeastDifference;
  }
  return axes;
}

Axes stationaryAxes(std::span<const DistanceField* const> examples,
                    const Array3D<std::uint8_t>* kept) {
  Axes all = Axes::every();
  for (std::size_t n = 0; n < examples.size(); ++n) {
    all = all & findStationaryAxes(*examples[n], n == 0 ? kept : nullptr);
  }
  return all;
}

}  // namespace exemplar
