// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/array3d.h"
#include "core/axes.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Finds the axes along which an example is stationary, so that its parts may move along them:
/// those along which the occupancy of its quarters does not differ by more than half of the solid's
/// (or the air's) share. `known`: samples that count, where not 0 (those it does not hold do not);
/// none for all. O(samples).
Axes findStationaryAxes(const DistanceField& example, const Array3D<std::uint8_t>* known = nullptr);

/// The axes along which all examples are stationary; of the first only what is kept counts, where
/// anything is (`kept` not null).
Axes stationaryAxes(std::span<const DistanceField* const> examples,
                    const Array3D<std::uint8_t>* kept = nullptr);

}  // namespace exemplar
