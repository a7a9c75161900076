// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"

/// Rough heights from ridges and valleys that somebody has drawn.
namespace exemplar {

/// A ridge or a valley.
struct TerrainLine {
  struct Point {
    double x = 0, y = 0;  ///< samples of the result, from its top left
    std::optional<double> height;
  };
  bool ridge = false;
  std::vector<Point> points;  ///< at least one; of a valley in the order in which its water runs
};

/// A guide for `TerrainControl`, and how much it counts where.
struct LinesGuide {
  Grid<float> heights, weight;
};

/// Heights along the lines, and a membrane between them, at most 192 samples a side. It counts in
/// full beside lines, and nothing from .04 of the longer side on, where land is as it would be
/// without them: wider, it would make land even beside them. Points without heights get some of the
/// examples': ridges one that .97 of their samples do not reach, valleys ones that fall from three
/// tenths of them to one twentieth. Heights far from lines go to the examples' median. Throws
/// `Cancelled`.
LinesGuide guideOfLines(std::span<const TerrainLine> lines, int width, int height,
                        std::span<const Grid<float>> examples, const Progress& progress = {});

}  // namespace exemplar
