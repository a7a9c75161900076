// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cmath>

#include "core/random.h"
#include "maps/layer_map.h"

/// Layer maps whose shapes are known.
namespace exemplar::testing {

/// Discs of one radius, on a jittered grid, each with a smaller disc of the next layer inside.
inline LayerVolume discs(int width, int height, int radius, std::uint64_t seed) {
  LayerVolume map(Vec3i{width, height, 1}, 1);
  const Random random(seed);
  const int step = 3 * radius;
  std::uint64_t n = 0;
  for (int cy = step / 2; cy + radius < height; cy += step) {
    for (int cx = step / 2; cx + radius < width; cx += step, ++n) {
      const double x0 = cx + random.uniform(-0.3, 0.3, n, 0) * radius;
      const double y0 = cy + random.uniform(-0.3, 0.3, n, 1) * radius;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double d = std::hypot(x - x0, y - y0);
          if (d <= radius) map(x, y, 0) = d <= 0.5 * radius ? 3 : 2;
        }
      }
    }
  }
  return map;
}

/// Sums of random waves, cut at equal areas: contours without a direction.
inline LayerVolume noiseLayers(int width, int height, int layers, std::uint64_t seed) {
  Grid<float> heights(width, height);
  const Random random(seed);
  for (std::uint64_t wave = 0; wave < 40; ++wave) {
    const double frequency = 2 + 14 * random.uniform(wave, 0);
    const double angle = 6.2832 * random.uniform(wave, 1), phase = 6.2832 * random.uniform(wave, 2);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        heights(x, y) += static_cast<float>(
            std::sin(6.2832 * frequency * (x * std::cos(angle) + y * std::sin(angle)) / width +
                     phase) /
            frequency);
  }
  std::vector<float> sorted(heights.values().begin(), heights.values().end());
  std::sort(sorted.begin(), sorted.end());
  LayerVolume map(Vec3i{width, height, 1}, 1);
  for (int i = 1; i < layers; ++i)
    for (std::size_t p = 0; p < map.count(); ++p)
      if (heights[p] >=
          sorted[sorted.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(layers)])
        map.data()[p] = static_cast<std::uint8_t>(i + 1);
  return map;
}

}  // namespace exemplar::testing
