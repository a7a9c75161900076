// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Along each axis, where in the example each sample of a result is, samples.
using AxisPlaces = std::array<std::vector<double>, 3>;

/// Whether places never go back: where parts are repeated they do.
inline bool isInOrder(const std::vector<double>& places) {
  return std::is_sorted(places.begin(), places.end());
}

/// An object made larger, before any of its parts are made anew.
struct StretchedObject {
  Array3D<float> values;  ///< voxels, below 0 inside
  Array3D<Vec3f> places;  ///< which place of the example each sample shows, samples

  /// The share of its samples that is solid, over the example's. O(samples).
  double solidRatio(const DistanceField& example) const;
};

/// An object stretched as space is: what is long and alike becomes longer, what is round becomes
/// flat. Good for what is made of planes. Where there would be more or less solid than the example
/// has, as a share of the box, those `places` that are in order are drawn toward even ones as
/// far as it takes to be within `kSolidBound`; stretched evenly there is as much. O(samples of the
/// result).
StretchedObject stretchSpace(const DistanceField& example, const AxisPlaces& places,
                             const Progress& progress = {});

/// An object stretched along its medial axis (Blum: "A transformation for extracting new
/// descriptors of shape", 1967): the balls that fill it move as `places` say, and all become larger
/// by one factor, so that there is as much solid as in the example, as a share of the box, within
/// `kSolidBound` if a factor between 1 and the greatest stretch does that. Good for limbs and thin
/// walls: they become longer, and stay round and of even thickness. Edges are rounded. All `places`
/// must be in order.
/// O(samples of the result, and balls x their volume); the same at any number of threads.
StretchedObject stretchSkeleton(const DistanceField& example, const AxisPlaces& places,
                                const Progress& progress = {});

/// How far from 1 the solid share of a stretched object may be, over the example's.
inline constexpr double kSolidBound = 0.05;

}  // namespace exemplar
