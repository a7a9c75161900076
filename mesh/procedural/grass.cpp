// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

constexpr std::array<float, 4> kSoil{0.16f, 0.095f, 0.05f, 1};

/// From the dark foot of a blade to its light tip.
std::array<float, 4> bladeColor(double share, double hue) {
  const auto mix = [&](double a, double b) {
    return static_cast<float>(a + (b - a) * std::min(1.0, std::max(0.0, share)));
  };
  const float warm = static_cast<float>(0.10 * hue);
  return {mix(0.04, 0.30) + warm, mix(0.13, 0.48) + 0.3f * warm, mix(0.02, 0.07), 1};
}

}  // namespace

ProcessSample makeGrass(const GrassProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress) {
  const Random places(seed, stream::kGrassPlaces), shapes(seed, stream::kGrassShapes);
  const double margin = process.length;
  const Vec3d window{process.side * extent.x, process.side * extent.y, 1.35 * process.length};
  ProcessSample sample;
  sample.box = {{0, 0, -process.soil}, {window.x, window.y, window.z * extent.z}};

  TriangleMesh soil =
      makeBox({{-margin, -margin, -process.soil - 40}, {window.x + margin, window.y + margin, 0}});
  soil.colors.assign(soil.positions.size(), kSoil);
  sample.mesh = std::move(soil);

  const auto roots =
      scatteredPoints(places, window.x + 2 * margin, window.y + 2 * margin, process.spacing);
  for (std::size_t n = 0; n < roots.size(); ++n) {
    progress.report("growing grass", static_cast<double>(n) / static_cast<double>(roots.size()));
    const double turn = shapes.uniform(0, 2 * std::numbers::pi, n, 0);
    const double tilt = shapes.uniform(0, 0.3, n, 1);
    const Vec3d lean{std::cos(turn), std::sin(turn), 0};
    Blade blade;
    blade.root = roots[n] - Vec3d{margin, margin, 1.5};
    blade.up = {lean.x * tilt, lean.y * tilt, 1};
    blade.lean = lean;
    blade.length = process.length * shapes.uniform(0.65, 1.25, n, 2);
    blade.bend = shapes.uniform(0.3, 1.15, n, 3);
    blade.width = process.width * shapes.uniform(0.85, 1.15, n, 4);
    blade.thickness = process.thickness;
    blade.tip = 0.45;
    TriangleMesh mesh = makeBlade(blade, 14, 12);
    const double hue = shapes.uniform(0, 1, n, 5);
    for (const Vec3d& p : mesh.positions) {
      mesh.colors.push_back(bladeColor(p.z / process.length, hue));
    }
    append(sample.mesh, mesh);
  }
  setMaterial(sample.mesh,
              {.name = "grass and soil", .baseColor = {1, 1, 1, 1}, .roughness = 0.75f});
  return sample;
}

}  // namespace exemplar
