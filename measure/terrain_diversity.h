// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "maps/grid.h"

/// How far results of terrain are apart, one of which may be another one, moved or turned.
namespace exemplar {

/// The layout of a map: where its chains and valleys lie, on the resolution on which its smaller
/// side has 40 to 79 cells.
class TerrainLayout {
 public:
  explicit TerrainLayout(const Grid<float>& heights);

  const Grid<float>& shape() const { return shape_; }

 private:
  Grid<float> shape_;  // the smoothed Laplacian, of mean 0 and length 1, 0 at holes and borders
};

/// How far two layouts are apart: 1 - the correlation of their Laplacians. 0 for one that is the
/// other, about 1 for two that have nothing to do with each other.
struct TerrainDistance {
  double plain = 0;  ///< as they lie
  /// After the best move, what leaves on one side coming in on the other, in the best of eight
  /// orientations. Of independent land .7 to .9: some move always suits a little. Maps that are not
  /// square are moved on a square with nothing beside them.
  double moved = 0;
};

/// One of any two layouts; both 1 for maps of different sizes or of one height. Eight correlations
/// by FFT, some 20 ms. The same at any number of threads. Throws `Cancelled`.
TerrainDistance distanceBetween(const TerrainLayout& a, const TerrainLayout& b,
                                const Progress& progress = {});

}  // namespace exemplar
