// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"

/// Copies in terrain that are turned by any angle, mirrored or not.
///
/// Shapes are the extrema of the Laplacian of smoothed heights, which stay where they are when land
/// is raised or tilted (Lindeberg: "Feature detection with automatic scale selection", IJCV 30(2),
/// 1998, doi:10.1023/A:1008045108935). The Laplacian on rings around one is compared with that
/// around another at all angles at once, by its Fourier coefficients along the rings.
namespace exemplar {

/// The strongest shapes of a map: those whose surroundings, within 9 cells, correlate at .85 or
/// more in some orientation are the same. Time grows with the product of the numbers of shapes that
/// are compared, some 2 microseconds each.
class TerrainShapes {
 public:
  /// Of a map, up to `most` (>= 1); none within 13 cells of its border or of a hole.
  TerrainShapes(const Grid<float>& heights, std::size_t most);
  ~TerrainShapes();
  TerrainShapes(TerrainShapes&&) noexcept;

  std::size_t count() const;
  /// The share of these that occur at another one, at any angle: nothing for fewer than two.
  std::optional<double> repeated(const Progress& progress = {}) const;
  /// The share of these that occur in others: nothing where there are none.
  std::optional<double> foundIn(const TerrainShapes& others, const Progress& progress = {}) const;

 private:
  class Surroundings;
  std::vector<Surroundings> shapes_;
};

/// How often a map is halved so that 40 to 79 cells are left along its smaller side: the resolution
/// on which its layout is looked at.
int layoutHalvings(const Grid<float>& heights);
Grid<float> layoutOf(const Grid<float>& heights, int halvings);

}  // namespace exemplar
