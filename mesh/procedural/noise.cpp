// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/noise.h"

#include <algorithm>
#include <cmath>

namespace exemplar {
namespace {

std::uint64_t latticeKey(std::int64_t i, std::int64_t j) {
  return static_cast<std::uint64_t>(i + (1ll << 30)) << 32 |
         static_cast<std::uint64_t>(j + (1ll << 30));
}

double smoothStep(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

}  // namespace

double latticeNoise(const Random& random, double x, double y, std::uint32_t draw) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
  const double u = smoothStep(x - fx), v = smoothStep(y - fy);
  const auto value = [&](std::int64_t a, std::int64_t b) {
    return random.uniform(-1, 1, latticeKey(a, b), draw);
  };
  const double low = value(i, j) * (1 - u) + value(i + 1, j) * u;
  const double high = value(i, j + 1) * (1 - u) + value(i + 1, j + 1) * u;
  return low * (1 - v) + high * v;
}

double fractalNoise(const Random& random, double x, double y, int octaves, double gain) {
  double sum = 0, amplitude = 1, frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    // Each octave's lattice is moved, so that lattice points do not coincide.
    sum += amplitude * latticeNoise(random, x * frequency + 0.37 * octave,
                                    y * frequency + 0.71 * octave, octave);
    amplitude *= gain;
    frequency *= 2;
  }
  return sum;
}

std::vector<Vec3d> scatteredPoints(const Random& random, double width, double height,
                                   double distance) {
  const double cell = distance / std::sqrt(2.0);
  const int columns = std::max(1, static_cast<int>(std::ceil(width / cell)));
  const int rows = std::max(1, static_cast<int>(std::ceil(height / cell)));
  std::vector<int> occupant(static_cast<std::size_t>(columns) * rows, -1);
  std::vector<Vec3d> points;
  // Enough darts that further ones would hardly find room.
  const std::uint64_t darts =
      static_cast<std::uint64_t>(40 * width * height / (distance * distance)) + 40;
  for (std::uint64_t dart = 0; dart < darts; ++dart) {
    const Vec3d p{random.uniform(0, width, dart, 0), random.uniform(0, height, dart, 1), 0};
    const int c = std::min(columns - 1, static_cast<int>(p.x / cell));
    const int r = std::min(rows - 1, static_cast<int>(p.y / cell));
    bool free = true;
    for (int j = std::max(0, r - 2); j <= std::min(rows - 1, r + 2) && free; ++j) {
      for (int i = std::max(0, c - 2); i <= std::min(columns - 1, c + 2) && free; ++i) {
        const int other = occupant[static_cast<std::size_t>(j) * columns + i];
        if (other >= 0 && length(points[other] - p) < distance) free = false;
      }
    }
    if (!free) continue;
    occupant[static_cast<std::size_t>(r) * columns + c] = static_cast<int>(points.size());
    points.push_back(p);
  }
  return points;
}

}  // namespace exemplar
