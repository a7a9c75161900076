// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/shaded_relief.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace exemplar {
namespace {

struct Gradient {
  double x, y;
};

/// By central differences, one-sided at borders and beside missing data.
Gradient gradientAt(const ReliefHeights& map, int x, int y) {
  const auto at = [&](int u, int v) {
    return map.heights[static_cast<std::size_t>(v) * map.width + u];
  };
  const double here = at(x, y);
  const auto along = [&](int u0, int v0, int u1, int v1, bool has0, bool has1) {
    double low = has0 ? at(u0, v0) : here, high = has1 ? at(u1, v1) : here;
    int steps = (has0 ? 1 : 0) + (has1 ? 1 : 0);
    if (std::isnan(low)) low = here, --steps;
    if (std::isnan(high)) high = here, --steps;
    return steps > 0 ? (high - low) / (steps * map.cellSize) : 0.0;
  };
  return {along(x - 1, y, x + 1, y, x > 0, x + 1 < map.width),
          along(x, y - 1, x, y + 1, y > 0, y + 1 < map.height)};
}

}  // namespace

Image8 shadedRelief(const ReliefHeights& map, const ReliefOptions& options) {
  assert(map.heights.size() == static_cast<std::size_t>(map.width) * map.height);
  Image8 picture{map.width, map.height, 3, {}};
  picture.pixels.resize(map.heights.size() * 3);
  const double across = std::cos(options.altitude);
  // Rows run down, so that the top is at negative y.
  const double lx = std::sin(options.azimuth) * across, ly = -std::cos(options.azimuth) * across;
  const double lz = std::sin(options.altitude);
  const double range = std::max(options.highest - options.lowest, 1e-30);
  parallelFor(0, static_cast<std::size_t>(map.height), 16, [&](std::size_t y0, std::size_t y1) {
    for (std::size_t row = y0; row < y1; ++row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < map.width; ++x) {
        std::uint8_t* pixel = picture.at(x, y);
        const std::size_t at = row * static_cast<std::size_t>(map.width) + x;
        const double h = map.heights[at];
        if (std::isnan(h)) {
          std::fill_n(pixel, 3, std::uint8_t{128});
          continue;
        }
        const Gradient g = gradientAt(map, x, y);
        const double gx = g.x * options.exaggeration, gy = g.y * options.exaggeration;
        const double light =
            std::max(0.0, (lz - gx * lx - gy * ly) / std::sqrt(1 + gx * gx + gy * gy));
        const double t = std::clamp((h - options.lowest) / range, 0.0, 1.0);
        const std::array<double, 3> tint{0.55 + 0.4 * t, 0.62 + 0.25 * t, 0.45 + 0.45 * t};
        constexpr std::array<double, 3> kWater{0.1, 0.25, 0.8};
        const bool wet = !map.water.empty() && map.water[at] != 0;
        for (std::size_t c = 0; c < 3; ++c) {
          double value = std::min(1.0, tint[c] * (0.15 + 1.05 * light));
          if (wet) value = 0.25 * value + 0.75 * kWater[c];
          pixel[c] = static_cast<std::uint8_t>(255 * value);
        }
      }
    }
  });
  return picture;
}

double reliefExaggeration(const ReliefHeights& map) {
  std::vector<float> slopes;
  const int every = 1 + map.height / 512;
  for (int y = 0; y < map.height; y += every) {
    for (int x = 0; x < map.width; ++x) {
      if (std::isnan(map.heights[static_cast<std::size_t>(y) * map.width + x])) continue;
      const Gradient g = gradientAt(map, x, y);
      slopes.push_back(static_cast<float>(std::hypot(g.x, g.y)));
    }
  }
  if (slopes.empty()) return 1;
  const auto at = static_cast<std::ptrdiff_t>(slopes.size() * 9 / 10);
  std::nth_element(slopes.begin(), slopes.begin() + at, slopes.end());
  const double steep = slopes[static_cast<std::size_t>(at)];
  return steep > 0 ? 0.84 / steep : 1;
}

}  // namespace exemplar
