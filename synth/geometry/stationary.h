// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Along which axes an example repeats itself, so that its parts may move along them.
struct StationaryAxes {
  bool x = true, y = true, z = true;
  bool operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const StationaryAxes&) const = default;
};

/// Finds the axes along which the example is stationary: those along which the occupancy of its
/// quarters does not differ by more than half of the solid's (or the air's) share. `known`: samples
/// that count, where not 0 (those it does not hold do not); none for all. O(samples).
StationaryAxes findStationaryAxes(const DistanceField& example,
                                  const Array3D<std::uint8_t>* known = nullptr);

}  // namespace exemplar
