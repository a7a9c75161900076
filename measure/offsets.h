// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "measure/occupancy.h"

namespace exemplar {

/// By how many motions a result's surface was taken from its examples. A motion is a source offset
/// (with its turns and example); motions whose offsets differ by up to `kOffsetReach` voxels along
/// each axis count as one, so that trembling does not make them many.
struct OffsetUse {
  /// The share of the surface that the commonest motion brought; 1 for a moved copy.
  double top = 0;
  /// The same where offsets that differ by whole sizes of the example are one: 1 for an example cut
  /// and exchanged, and for a tiling.
  double topRolled = 0;
  /// How many motions, the commonest first, make 95 % of the surface.
  std::int64_t offsets95 = 0;
};

inline constexpr int kOffsetReach = 2;  ///< voxels

/// Over the solid cells of `result` with an empty cell at one of their faces; the faces of the box
/// are no surface. Origins have the result's size; all examples count as `exampleSize` cells large.
/// All zero for a result without surface. O(cells log offsets). Throws `Cancelled`.
OffsetUse offsetUse(const Occupancy& result, const Origins& origins, const Vec3i& exampleSize,
                    const Progress& progress = {});

/// How much of a result's surface, as above, each of several examples made: one share for each, all
/// zero for a result without surface. O(cells).
std::vector<double> surfaceShares(const Occupancy& result, const Origins& origins,
                                  std::size_t examples);

}  // namespace exemplar
