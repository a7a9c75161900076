// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

constexpr std::array<float, 4> kMortar{0.55f, 0.52f, 0.47f, 1};

/// From dark and burnt to light and sandy.
std::array<float, 4> brickColor(double burnt) {
  const auto mix = [&](double light, double dark) {
    return static_cast<float>(light + (dark - light) * burnt);
  };
  return {mix(0.46, 0.20), mix(0.17, 0.07), mix(0.09, 0.045), 1};
}

}  // namespace

ProcessSample makeBricks(const BricksProcess& process, const Vec3d& extent, std::uint64_t seed,
                         const Progress& progress) {
  const Random random(seed, stream::kBricks);
  const double bed = 6, air = 2, least = process.jitter * process.height;
  ProcessSample sample;
  sample.box.min = {0, 0, -bed};
  sample.box.max = {process.columns * process.length * extent.x,
                    process.courses * process.height * extent.y,
                    std::ceil(process.relief + 3 * least + air)};

  const double margin = process.length;
  sample.mesh = makeBox(
      {{-margin, -margin, -4 * bed}, {sample.box.max.x + margin, sample.box.max.y + margin, 0}});
  setMaterial(sample.mesh, {.name = "mortar", .baseColor = {1, 1, 1, 1}, .roughness = 0.95f});
  sample.mesh.colors.assign(sample.mesh.positions.size(), kMortar);

  const int columns = static_cast<int>(std::ceil(process.columns * extent.x)) + 1;
  const int courses = static_cast<int>(std::ceil(process.courses * extent.y)) + 1;
  TriangleMesh bricks;
  for (int course = -1; course < courses; ++course) {
    progress.report("laying bricks", static_cast<double>(course + 1) / (courses + 1));
    for (int column = -1; column < columns; ++column) {
      const std::uint64_t key =
          static_cast<std::uint64_t>(course + 1000) * 100000 + (column + 1000);
      const auto jitter = [&](std::uint32_t draw) {
        return random.uniform(-1, 1, key, draw) * least;
      };
      const Vec3d middle{(column + (course & 1 ? 1.0 : 0.5)) * process.length + jitter(0),
                         (course + 0.5) * process.height + jitter(1), jitter(2)};
      const Vec3d half{0.5 * (process.length - process.joint) + 0.5 * jitter(3),
                       0.5 * (process.height - process.joint) + 0.5 * jitter(4), process.relief};
      TriangleMesh brick = makeRoundedBox({-1 * half, half}, std::min(0.9, 0.3 * process.relief));
      // Leaning a little, as a hand lays them.
      const double across = 0.8 * jitter(5) / process.height,
                   along = 0.3 * jitter(6) / process.height;
      const double turn = 0.5 * jitter(7) / process.length;
      for (Vec3d& p : brick.positions) {
        p = {p.x - turn * p.y, p.y + turn * p.x, p.z + across * p.y + along * p.x};
        p = p + middle;
      }
      brick.colors.assign(brick.positions.size(), brickColor(random.uniform(0, 1, key, 8)));
      append(bricks, brick);
    }
  }
  setMaterial(bricks, {.name = "brick", .baseColor = {1, 1, 1, 1}, .roughness = 0.85f});
  append(sample.mesh, bricks);
  return sample;
}

}  // namespace exemplar
