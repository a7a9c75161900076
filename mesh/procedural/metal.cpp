// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/rough_ground.h"

namespace exemplar {

ProcessSample makeMetal(const MetalProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress) {
  const Random places(seed, stream::kMetalPlaces), shapes(seed, stream::kMetalShapes),
      roughness(seed, stream::kMetalRoughness);
  const RoughGround ground{.window = extent * process.side,
                           .margin = 2 * process.grain,
                           .relief = process.relief,
                           .highest = 1.2,
                           .depth = process.depth};
  const auto grains = scatteredPoints(places, ground.window.x + 2 * ground.margin,
                                      ground.window.y + 2 * ground.margin, process.grain);
  ProcessSample sample = ground.make("shaping grains", progress, [&](double x, double y) {
    const Vec3d p{x, y, 0};
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
    const double rough = 0.07 * fractalNoise(roughness, x / 5, y / 5, 3);
    return (level + slope) * (0.3 + 0.7 * std::sqrt(groove)) + rough;
  });
  setMaterial(sample.mesh, {.name = "rough metal",
                            .baseColor = {0.50f, 0.47f, 0.44f, 1},
                            .metallic = 1,
                            .roughness = 0.55f});
  return sample;
}

}  // namespace exemplar
