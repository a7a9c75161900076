// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "synth/continuous/search.h"

/// Where a result is full and where it is empty (thesis, section 4.6.3).
namespace exemplar::continuous {

/// Values over the box of a result, x fastest: 0, nothing is built; 0.5, as without a map; 1, what
/// is built is as likely as can be. Axes with one voxel are all alike.
struct DensityMap {
  Vec3i size{1, 1, 1};
  std::vector<float> values;  ///< 0..1

  /// The value at a point, in shares of the box, of the voxel around it; beyond the box, the
  /// nearest one's.
  float at(const Vec3d& share) const;
};

/// Removes labels with anything built (all but air, and what is below the ground's height) in cells
/// where a map is 0, and returns how likely the others are. `box` is the result's. A cell has the
/// map's values near its corners.
Guide applyDensityMap(const DensityMap& map, const ExactBox& box,
                      const std::optional<Ground>& ground, Puzzle& puzzle,
                      std::span<const std::uint32_t> vertices);

}  // namespace exemplar::continuous
