// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/progress.h"
#include "maps/grid.h"

/// A ruler for terrain: how alike, how new and how seamless a map of heights is, from the heights
/// alone. Heights and the distance of cells are in one unit; NaN is no data.
namespace exemplar {

struct TerrainOptions {
  double cellSize = 1;  ///< distance of neighboring heights, in the heights' unit; > 0
  /// Whether the unit is known to be a meter; areas are then also counted in square kilometers.
  bool meters = false;
  /// Streams are where so many cells drain through; >= 2.
  std::uint32_t streamCells = 100;
};

/// What one map is like. Nothing where a figure has no meaning.
struct TerrainFigures {
  std::int64_t width = 0, height = 0;
  std::optional<double> relief;  ///< highest less lowest

  /// The share of cells below their spill level: no water runs off there.
  std::optional<double> floodedShare;
  std::optional<double> depressions;      ///< closed ones for each million cells
  std::optional<double> depressionsKm2;   ///< the same for each square kilometer
  std::optional<double> depressionDepth;  ///< mean
  std::optional<double> drainageDensity;  ///< length of streams for each area, 1 / unit
  std::optional<double> bifurcation;      ///< `StreamNetwork::bifurcationRatio`
  std::optional<double> highestOrder;     ///< Strahler's, of the largest stream
  /// Mean length of valley lines (`flowLines` cut at closed depressions), and the mean of those on
  /// which a point of one lies, which weights them by their length: one broken river shows in it.
  std::optional<double> valleyLength, valleyReach;
  std::optional<double> ridgeLength;    ///< the mean of lines of the negated map, uncut
  std::optional<double> spectrumSlope;  ///< `spectrumSlope`
  /// The largest step between neighboring cells.
  std::optional<double> largestStep;
  /// The share of cells whose slope is under 2 % of the mean slope: what terraces, plateaus and
  /// hollows that were filled up have.
  std::optional<double> flatShare;
  std::optional<double> repeatedPeaks;  ///< `repeatedPeaks`
  /// Of the 400 strongest shapes, the share that occurs at another one at any angle
  /// (`TerrainShapes`).
  std::optional<double> repeatedShapes;
};

/// Measures one map. `spectrumSide` is the side of the spectrum's windows (a power of two; 0: as
/// the map allows, at most 512). About 20 s of one core for 4096 x 4096 cells. The same at any
/// number of threads. Throws `InputError` for options out of range and an empty map, and
/// `Cancelled`.
TerrainFigures terrainFigures(const Grid<float>& heights, const TerrainOptions& options = {},
                              int spectrumSide = 0, const Progress& progress = {});

/// Where the source of a result changes: bit 1 of a cell between it and its right neighbor, bit 2
/// between it and the one below.
inline constexpr std::uint8_t kSeamRight = 1, kSeamBelow = 2;

/// A result against its example.
struct TerrainLikeness {
  TerrainFigures example, result;
  /// Of the example's two halves, cut across its longer side; without figures where it is too small
  /// (under 64 cells).
  TerrainFigures firstHalf, secondHalf;

  /// Of the result to the example; the floor is that of the example's halves.
  struct Distance {
    std::optional<double> result, floor;
  };
  /// Earth mover's distances to the example's distribution, in standard deviations of that; 0 is
  /// best.
  Distance heights;
  Distance slopes;     ///< of the rise for each length, by central differences
  Distance curvature;  ///< of the second difference, hollows positive

  std::optional<double> verbatimShare;  ///< `verbatimShare`
  /// Of the result's 400 strongest shapes, the share that occurs among the example's 1,000 at any
  /// angle; the floor is the share of those of its one half in the other.
  Distance copiedShapes;
  /// The same on the resolution on which the example has 40 to 79 cells along its smaller side:
  /// whether its mountains and main valleys come again.
  Distance copiedLayout;
  /// The largest step of the result over the example's.
  std::optional<double> stepRatio;
  /// Where seams are known: the largest and the mean step across them over the example's.
  std::optional<double> seamStepRatio, seamMeanStepRatio;
};

/// Measures a result against its example; `seams` (of the result's size; null where they are not
/// known) says where it was put together. Up to a million cells of each map, on an even lattice,
/// stand for the distributions. Cost, threads and errors as above, for both maps.
TerrainLikeness measureTerrain(const Grid<float>& example, const Grid<float>& result,
                               const TerrainOptions& options = {},
                               const Grid<std::uint8_t>* seams = nullptr,
                               const Progress& progress = {});

}  // namespace exemplar
