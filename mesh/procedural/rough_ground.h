// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "mesh/primitives.h"
#include "mesh/procedural/processes.h"

namespace exemplar {

/// Ground that goes on beyond its window, as heights of a half apart: what metal and bark are.
struct RoughGround {
  Vec3d window;        ///< its x and y
  double margin = 0;   ///< around it
  double relief = 1;   ///< world units for a height of 1
  double highest = 1;  ///< heights are cut off there, and below 0
  double depth = 1;    ///< of the solid below 0, world units

  /// `height(x, y)` is asked from the margin's corner on. Reports to `progress` as `stage`.
  template <typename Height>
  ProcessSample make(std::string_view stage, const Progress& progress, const Height& height) const {
    const double cell = 0.5, air = 2;
    const int columns = static_cast<int>((window.x + 2 * margin) / cell) + 1;
    const int rows = static_cast<int>((window.y + 2 * margin) / cell) + 1;
    std::vector<double> heights(static_cast<std::size_t>(columns) * rows);
    for (int r = 0; r < rows; ++r) {
      progress.report(stage, static_cast<double>(r) / rows);
      for (int c = 0; c < columns; ++c)
        heights[static_cast<std::size_t>(r) * columns + c] =
            std::clamp(height(c * cell, r * cell), 0.0, highest) * relief;
    }
    ProcessSample sample;
    sample.box = {{0, 0, -depth}, {window.x, window.y, std::ceil(highest * relief) + air}};
    sample.mesh =
        makeHeightFieldSolid({-margin, -margin, 0}, cell, columns, rows, heights, -3 * depth);
    return sample;
  }
};

}  // namespace exemplar
