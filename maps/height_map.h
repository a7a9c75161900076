// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>

#include "maps/grid.h"

namespace exemplar {

/// How a file of integers (.png, .pgm, .r16) counts heights.
struct HeightSteps {
  double size = 1;      ///< world height of one step, > 0
  int largest = 65535;  ///< the largest integer that the file can hold: 255 at 8 bits
  double offset = 0;    ///< world height of the integer 0
};

/// The southwestern corner of a map's southwestern cell, in the file's coordinates.
struct MapCorner {
  double west = 0, south = 0;
  bool operator==(const MapCorner&) const = default;
};

/// Heights over a regular grid of points, row 0 at the largest y (north), as in the files.
struct HeightMap {
  Grid<float> heights;  ///< world units; NaN where there is no data
  double cellSize = 1;  ///< distance of neighboring points, world units
  /// Whether a file or the user said the cell size; else it was made up.
  bool cellSizeKnown = false;
  std::optional<MapCorner> corner;  ///< where a file said it
  /// Of the file that the heights came from, so that others can be written like it; nothing where
  /// they never were integers.
  std::optional<HeightSteps> steps;

  int width() const { return heights.width(); }    ///< points along x
  int height() const { return heights.height(); }  ///< points along y
  float at(int column, int row) const { return heights(column, row); }
};

/// The lowest and the highest of the heights; nothing where all are holes.
struct HeightRange {
  float low = 0, high = 0;
  std::size_t holes = 0;  ///< cells without data
  double relief() const { return double{high} - low; }
};
std::optional<HeightRange> rangeOf(const Grid<float>& heights);

/// Gives cells without data the mean of their neighbors that have it, ring by ring from the border
/// of each hole. Returns how many there were; without any data nothing changes. O(cells).
std::size_t fillHoles(Grid<float>& heights);

}  // namespace exemplar
