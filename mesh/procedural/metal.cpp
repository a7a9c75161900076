// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/processes.h"

namespace exemplar {

ProcessSample makeMetal(const MetalProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress) {
  const Random places(seed, stream::kMetalPlaces), shapes(seed, stream::kMetalShapes),
      roughness(seed, stream::kMetalRoughness);
  const double margin = 2 * process.grain, cell = 0.5;
  const Vec3d window = extent * process.side;
  const int columns = static_cast<int>((window.x + 2 * margin) / cell) + 1;
  const int rows = static_cast<int>((window.y + 2 * margin) / cell) + 1;
  const auto grains =
      scatteredPoints(places, window.x + 2 * margin, window.y + 2 * margin, process.grain);

  std::vector<double> heights(static_cast<std::size_t>(columns) * rows);
  for (int r = 0; r < rows; ++r) {
    progress.report("shaping grains", static_cast<double>(r) / rows);
    for (int c = 0; c < columns; ++c) {
      const Vec3d p{c * cell, r * cell, 0};
      // Each grain a tilted plane about its own level; the nearest grain counts, with a groove
      // where the two nearest are as near as each other.
      const auto [grain, nearest, second] = twoNearest(grains.size(), [&](std::size_t n) {
        return length(grains[n] - p) * shapes.uniform(0.75, 1.35, n, 0);
      });
      const Vec3d d = p - grains[grain];
      const double level = shapes.uniform(0.25, 1, grain, 1);
      const double slope = shapes.uniform(-0.045, 0.045, grain, 2) * d.x +
                           shapes.uniform(-0.045, 0.045, grain, 3) * d.y;
      const double groove = std::clamp((second - nearest) / (0.35 * process.grain), 0.0, 1.0);
      const double rough = 0.07 * fractalNoise(roughness, p.x / 5, p.y / 5, 3);
      const double h = (level + slope) * (0.3 + 0.7 * std::sqrt(groove)) + rough;
      heights[static_cast<std::size_t>(r) * columns + c] = std::clamp(h, 0.0, 1.2) * process.relief;
    }
  }
  ProcessSample sample;
  const double air = 2;
  sample.box = {{0, 0, -process.depth},
                {window.x, window.y, std::ceil(1.2 * process.relief) + air}};
  sample.mesh =
      makeHeightFieldSolid({-margin, -margin, 0}, cell, columns, rows, heights, -3 * process.depth);
  setMaterial(sample.mesh, {.name = "rough metal",
                            .baseColor = {0.50f, 0.47f, 0.44f, 1},
                            .metallic = 1,
                            .roughness = 0.55f});
  return sample;
}

}  // namespace exemplar
