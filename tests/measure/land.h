// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/random.h"
#include "maps/drainage.h"
#include "maps/grid.h"

namespace exemplar::testing {

/// Smooth noise: octaves of values at the corners of squares, between -1 and 1 for the coarsest.
inline Grid<float> noise(int width, int height, std::uint64_t seed, int coarsest) {
  Grid<float> sum(width, height);
  double amplitude = 1;
  for (int cell = coarsest; cell >= 1; cell /= 2, amplitude /= 2) {
    const Random random(seed, static_cast<std::uint32_t>(cell));
    const auto corner = [&](int x, int y) {
      return random.uniform(-1, 1, static_cast<std::uint64_t>(y) * 65536 + x);
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int i = x / cell, j = y / cell;
        const double s = static_cast<double>(x % cell) / cell,
                     t = static_cast<double>(y % cell) / cell;
        const double top = corner(i, j) * (1 - s) + corner(i + 1, j) * s;
        const double bottom = corner(i, j + 1) * (1 - s) + corner(i + 1, j + 1) * s;
        sum(x, y) += static_cast<float>(amplitude * (top * (1 - t) + bottom * t));
      }
    }
  }
  return sum;
}

/// Land that rivers have shaped: along the flow over noise, slopes fall with the area that drains
/// through them (the steady state of the stream power law, with an exponent of 0.45). No closed
/// depressions, about 50 to 100 high.
inline Grid<float> land(int width, int height, std::uint64_t seed) {
  Grid<float> heights = noise(width, height, seed, 64);
  for (int round = 0; round < 4; ++round) {
    const Drainage drainage = drain(heights);
    const Grid<std::uint32_t> sum = flowAccumulation(drainage);
    const Grid<float> roughness = noise(width, height, seed + 77, 16);
    for (const std::uint32_t cell : drainage.order) {
      const std::uint8_t direction = drainage.directions[cell];
      if (direction >= 8) {
        heights[cell] = 0;
        continue;
      }
      const int x = static_cast<int>(cell) % width, y = static_cast<int>(cell) / width;
      const Pixel step = kNeighbors[direction];
      const double length = direction % 2 ? std::numbers::sqrt2 : 1;
      const double slope = (3 + roughness[cell]) * std::pow(sum[cell], -0.45);
      heights[cell] = heights(x + step.x, y + step.y) + static_cast<float>(slope * length);
    }
  }
  return heights;
}

}  // namespace exemplar::testing
