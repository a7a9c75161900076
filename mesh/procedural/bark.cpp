// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

/// From the dark of a furrow (0) to weathered gray (1).
std::array<float, 4> barkColor(double height) {
  const auto mix = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * std::clamp(height, 0.0, 1.0));
  };
  return {mix(0.06, 0.36), mix(0.03, 0.28), mix(0.015, 0.20), 1};
}

}  // namespace

ProcessSample makeBark(const BarkProcess& process, const Vec3d& extent, std::uint64_t seed,
                       const Progress& progress) {
  const Random places(seed, stream::kBarkPlaces), shapes(seed, stream::kBarkShapes),
      noise(seed, stream::kBarkNoise);
  const double margin = 2 * process.plate, cell = 0.5;
  const Vec3d window = extent * process.side;
  const int columns = static_cast<int>((window.x + 2 * margin) / cell) + 1;
  const int rows = static_cast<int>((window.y + 2 * margin) / cell) + 1;
  // Plates are cells of a plane that is pressed together along y.
  const auto plates = scatteredPoints(places, window.x + 4 * margin,
                                      (window.y + 4 * margin) / process.grain, process.plate);

  std::vector<double> heights(static_cast<std::size_t>(columns) * rows);
  for (int r = 0; r < rows; ++r) {
    progress.report("splitting bark", static_cast<double>(r) / rows);
    for (int c = 0; c < columns; ++c) {
      const double x = c * cell, y = r * cell / process.grain;
      const double bend = 0.35 * process.plate;
      const Vec3d p{x + margin + bend * fractalNoise(noise, x / 14, y / 9, 2),
                    y + margin / process.grain + bend * fractalNoise(shapes, x / 9, y / 9, 2), 0};
      const auto [plate, first, second] =
          twoNearest(plates.size(), [&](std::size_t n) { return length(plates[n] - p); });
      const double furrow = std::clamp((second - first) / (0.3 * process.plate), 0.0, 1.0);
      const double level = shapes.uniform(0.7, 1, plate, 9);
      const double fibers = 0.12 * fractalNoise(noise, x / 3, y / 3.5, 3, 0.6);
      const double height = level * (1 - (1 - furrow) * (1 - furrow)) + fibers * (0.4 + furrow);
      heights[static_cast<std::size_t>(r) * columns + c] =
          std::clamp(height, 0.0, 1.15) * process.relief;
    }
  }
  ProcessSample sample;
  const double air = 2;
  sample.box = {{0, 0, -process.depth},
                {window.x, window.y, std::ceil(1.15 * process.relief) + air}};
  sample.mesh =
      makeHeightFieldSolid({-margin, -margin, 0}, cell, columns, rows, heights, -3 * process.depth);
  for (const Vec3d& p : sample.mesh.positions)
    sample.mesh.colors.push_back(barkColor(p.z / process.relief));
  setMaterial(sample.mesh, {.name = "bark", .baseColor = {1, 1, 1, 1}, .roughness = 0.9f});
  return sample;
}

}  // namespace exemplar
