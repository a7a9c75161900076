// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/stationary.h"

#include <algorithm>

namespace exemplar {

StationaryAxes findStationaryAxes(const DistanceField& example,
                                  const Array3D<std::uint8_t>* known) {
  StationaryAxes axes;
  bool* flags[] = {&axes.x, &axes.y, &axes.z};
  const Vec3i n = example.size();
  for (int axis = 0; axis < 3; ++axis) {
    // The occupancy of each quarter of the axis: where quarters differ by more than half of what
    // there is (of solid or of air, whichever is less), the axis has a place of its own for things.
    double occupied[4] = {}, count[4] = {};
    for (std::size_t s = 0; s < example.values.count(); ++s) {
      const Vec3i p = example.values.ijk(s);
      if (known && !(known->contains(p) && (*known)[p])) continue;
      const int part = p[axis] * 4 / n[axis];
      occupied[part] += example.values.values()[s] < 0;
      count[part] += 1;
    }
    double low = 1, high = 0;
    for (int part = 0; part < 4; ++part) {
      if (count[part] == 0) continue;
      low = std::min(low, occupied[part] / count[part]);
      high = std::max(high, occupied[part] / count[part]);
    }
    const double mean = (occupied[0] + occupied[1] + occupied[2] + occupied[3]) /
                        std::max(1.0, count[0] + count[1] + count[2] + count[3]);
    *flags[axis] = high - low <= 0.5 * std::min(mean, 1 - mean) + 0.02;
  }
  return axes;
}

}  // namespace exemplar
