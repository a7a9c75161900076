// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "maps/height_map.h"

/// Tiles: height maps whose corners say that they lie side by side.
namespace exemplar {

enum class TileFit {
  Apart,     ///< not side by side, or unknown where; maps of one place are apart, too
  Fits,      ///< they go on from each other
  OffGrid,   ///< side by side, but not a whole number of cells apart
  Disagrees  ///< side by side, with other heights along the edge that they share
};

/// How a map lies beside another.
struct TilePlace {
  TileFit fit = TileFit::Apart;
  double east = 0, north = 0;  ///< from the other's southwestern corner to its own, cells
  /// Along their edge: how much heights differ from one map to the other, and from neighbor to
  /// neighbor inside them; means.
  double across = 0, usual = 0;
};

/// Looks at where two maps of one cell size lie. Side by side are maps that share 8 cells of an
/// edge or more, with a gap of less than one cell or an overlap of up to 16. Their heights disagree
/// where they differ by more than four times what neighbors do, and by a fiftieth of the relief.
TilePlace placeOf(const HeightMap& map, const HeightMap& beside);

/// The map of tiles that lie on one grid of cells (each `Fits` another one): over their bounding
/// box, without data where no tile lies. Where tiles overlap the first one's heights count. Throws
/// `InputError` where that would not fit in memory, as of tiles along a diagonal.
HeightMap joinedTiles(std::span<const HeightMap> tiles);

}  // namespace exemplar
