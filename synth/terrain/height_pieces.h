// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"
#include "synth/terrain/height_origin.h"
#include "synth/terrain/height_patches.h"

/// Pieces of limited size: from where a resolution takes its shapes, so that what is recognizable
/// in an example does not come again.
///
/// A resolution that went on with the places of the coarser one would copy: what was taken from a
/// place fits best where it was. Each piece looks instead for another place whose coarse heights
/// are like those around its middle, so that every resolution combines other places. That detail
/// depends on what lies below it only through what is coarser is the assumption of Gain, Merry,
/// Marais 2015 and of Guérin et al. ("Sparse representation of terrains", 2016, doi:
/// 10.1111/cgf.12821).
namespace exemplar {

struct PieceOptions {
  int size = 9;             ///< distance of pieces' middles, samples; >= kHeightPatch
  std::size_t sources = 0;  ///< only so many of the sources, the first ones, are used; 0: all
  double meanCost = 0.05;   ///< what the difference of mean heights counts
  double slopes = 4;        ///< what differences of steps count
  int tries = 1000;         ///< random places that each piece looks at
  std::uint64_t seed = 0;
  std::uint64_t level = 0;    ///< which resolution it is: each draws other numbers
  std::vector<int> turns{0};  ///< of `turnedStep`: the orientations in which places are used
  bool wrapsX = false, wrapsY = false;
};

struct HeightPieces {
  std::vector<Pixel> middles;
  /// What the sample at a piece's middle comes from; it may lie beside the example, not the piece.
  std::vector<HeightOrigin> origins;
  int columns = 0, rows = 0;  ///< pieces lie in a grid of cells, one in each
  int width = 0, height = 0;  ///< of the result
  bool wrapsX = false, wrapsY = false;
  int reach = 0;  ///< how far patches may lie from the middle of their piece, samples

  /// The piece whose middle is nearest, and the step to a sample from there.
  struct Share {
    std::uint32_t piece;
    Pixel step;
  };
  Share over(Pixel at) const;
};

/// Chooses pieces for a result of `size`, whose heights and origins on half the resolution are
/// known, by the examples on half the resolution. No piece has at its middle, in whatever
/// orientation or bent copy, the place of an example from which the coarser heights come, or one
/// with which a neighbor would go on. Time grows with the pieces; the same at any number
/// of threads. Throws `Cancelled`.
HeightPieces choosePieces(std::span<const HeightSource> coarse, const Grid<float>& heights,
                          const Grid<HeightOrigin>& origins, Pixel size,
                          const PieceOptions& options, const Progress& progress);

}  // namespace exemplar
