// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "sdf/distance_field.h"

/// Where in a result of another size that which is kept of its example goes: an end stays an end.
namespace exemplar {

/// Slices from `begin` to before `end`.
struct SliceRange {
  int begin = 0, end = 0;
  bool operator==(const SliceRange&) const = default;
};

/// The ranges of slices along an axis in which something is kept (`kept` is not 0), in order.
/// Ranges that are nearer than an eighth of the axis are one. O(samples).
std::vector<SliceRange> keptRanges(const Array3D<std::uint8_t>& kept, int axis);

/// Samples of a result that are kept, as `VotingOptions` takes them.
struct KeptPlaces {
  Array3D<std::uint8_t> kept;  ///< of the result's size: 0, or 1 + the number of the offset
  std::vector<Vec3i> offsets;  ///< by which what is kept is moved, samples; empty where none is
  Vec3i offset{0, 0, 0};       ///< of what is kept nearest to the low ends
};

/// Places what is kept of an example (not 0, of its size) in a result of `size`. Along each axis:
/// what is kept of one end of the solid keeps its distance to that end, what is kept between the
/// ends stays between them in proportion, and where both ends are kept with more than an eighth of
/// the axis between them, each goes to its own. What is kept whole, or along an axis of `periodic`,
/// stays where it is. O(samples); deterministic.
KeptPlaces placeKept(const DistanceField& example, const Array3D<std::uint8_t>& kept,
                     const Vec3i& size, const Axes& periodic);

}  // namespace exemplar
