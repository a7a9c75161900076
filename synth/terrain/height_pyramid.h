// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "maps/grid.h"
#include "synth/terrain/height_patches.h"

/// Heights on several resolutions.
namespace exemplar {

/// A resolution of the examples.
struct HeightLevel {
  std::vector<HeightSource> sources;
  /// Heights less what the next coarser resolution has there; 0 on the coarsest.
  std::vector<Grid<float>> details;
  double bank = 1;  ///< a steep step between neighbors
  /// Of each source what is flat water; none where no example has any.
  std::vector<Grid<std::uint8_t>> water;
};

/// The examples on `levels` resolutions, the finest first; each is the mean of 2 x 2 samples of the
/// one before, a last odd row or column is left out.
std::vector<HeightLevel> heightPyramid(std::span<const Grid<float>> examples, int levels);

/// Heights less what half their resolution has there.
Grid<float> detailOf(const Grid<float>& heights, const Grid<float>& half);

/// The height at sample (x, y) of twice the resolution, linearly between the middles of samples.
float between(const Grid<float>& half, int x, int y, bool wrapsX, bool wrapsY);

/// The means of 2 x 2 samples; a last odd row or column is a sample of its own.
Grid<float> coarser(const Grid<float>& heights);
/// The means of 2 x 2 samples, each weighted.
Grid<float> coarser(const Grid<float>& heights, const Grid<float>& weights);

/// A grid stretched to another size: linear between its samples where it grows, means over areas
/// where it shrinks.
Grid<float> stretched(const Grid<float>& heights, int width, int height);

}  // namespace exemplar
