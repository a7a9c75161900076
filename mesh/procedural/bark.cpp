// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/rough_ground.h"

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
  const RoughGround ground{.window = extent * process.side,
                           .margin = 2 * process.plate,
                           .relief = process.relief,
                           .highest = 1.15,
                           .depth = process.depth};
  // Plates are cells of a plane that is pressed together along y.
  const double margin = ground.margin;
  const auto plates =
      scatteredPoints(places, ground.window.x + 4 * margin,
                      (ground.window.y + 4 * margin) / process.grain, process.plate);
  ProcessSample sample = ground.make("splitting bark", progress, [&](double x, double across) {
    const double y = across / process.grain, bend = 0.35 * process.plate;
    const Vec3d p{x + margin + bend * fractalNoise(noise, x / 14, y / 9, 2),
                  y + margin / process.grain + bend * fractalNoise(shapes, x / 9, y / 9, 2), 0};
    const auto [plate, first, second] =
        twoNearest(plates.size(), [&](std::size_t n) { return length(plates[n] - p); });
    const double furrow = std::clamp((second - first) / (0.3 * process.plate), 0.0, 1.0);
    const double level = shapes.uniform(0.7, 1, plate, 9);
    const double fibers = 0.12 * fractalNoise(noise, x / 3, y / 3.5, 3, 0.6);
    return level * (1 - (1 - furrow) * (1 - furrow)) + fibers * (0.4 + furrow);
  });
  for (const Vec3d& p : sample.mesh.positions)
    sample.mesh.colors.push_back(barkColor(p.z / process.relief));
  setMaterial(sample.mesh, {.name = "bark", .baseColor = {1, 1, 1, 1}, .roughness = 0.9f});
  return sample;
}

}  // namespace exemplar
