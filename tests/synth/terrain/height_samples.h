// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/random.h"
#include "maps/grid.h"

namespace exemplar::testing {

/// Smooth noise of a wavelength, -1 to 1.
inline double smoothNoise(double x, double y, std::uint64_t seed) {
  const Random random(seed, 0x7465);
  const double fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](double cx, double cy) {
    const auto key = static_cast<std::uint64_t>((static_cast<std::int64_t>(cy) + 5000) * 20000 +
                                                static_cast<std::int64_t>(cx) + 5000);
    return 2 * random.uniform(key) - 1;
  };
  const auto ease = [](double t) { return t * t * (3 - 2 * t); };
  const double u = ease(x - fx), v = ease(y - fy);
  return (at(fx, fy) * (1 - u) + at(fx + 1, fy) * u) * (1 - v) +
         (at(fx, fy + 1) * (1 - u) + at(fx + 1, fy + 1) * u) * v;
}

/// Mountains: ridges of several sizes, 0 to about 1000 high.
inline Grid<float> ridges(int width, int height, std::uint64_t seed, double stretch = 1) {
  Grid<float> heights(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0, size = 64, high = 500;
      for (std::uint64_t octave = 0; octave < 5; ++octave) {
        sum += high * (1 - std::abs(smoothNoise(x / size, y / (size * stretch), seed + octave)));
        size /= 2;
        high /= 2.2;
      }
      heights(x, y) = static_cast<float>(sum);
    }
  }
  return heights;
}

/// Independent heights, 0 to 1.
inline Grid<float> noise(int width, int height, std::uint64_t seed) {
  Grid<float> heights(width, height);
  const Random random(seed, 0x6e6f);
  for (std::size_t s = 0; s < heights.count(); ++s)
    heights[s] = static_cast<float>(random.uniform(s));
  return heights;
}

}  // namespace exemplar::testing
