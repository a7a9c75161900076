// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/distance_field.h"

namespace exemplar {

/// Along which axes an example repeats itself, so that its parts may move along them.
struct StationaryAxes {
  bool x = true, y = true, z = true;
  bool operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const StationaryAxes&) const = default;
};

/// Finds the axes along which the example is stationary: those along which the occupancy of its
/// quarters does not differ by more than half of the solid's (or the air's) share. O(samples).
StationaryAxes findStationaryAxes(const DistanceField& example);

}  // namespace exemplar
