// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/processes.h"

namespace exemplar {

ProcessSample makeGrid(const GridProcess& process, const Vec3d& extent, std::uint64_t seed) {
  const Random random(seed, 0x6f1d);
  const auto node = [&](int i, int j, int k) {
    const std::uint64_t key = (static_cast<std::uint64_t>(k + 8) * 4096 + (j + 8)) * 4096 + (i + 8);
    Vec3d p{i + 0.5, j + 0.5, k + 0.5};
    p *= process.cell;
    for (int axis = 0; axis < 3; ++axis) {
      // Three deviations at most, so that rods keep apart.
      p[axis] += process.jitter * std::clamp(random.normal(key, 2 * axis), -2.0, 2.0) * 0.5;
    }
    return p;
  };
  ProcessSample sample;
  sample.box.min = {0, 0, 0};
  sample.box.max = extent * (process.cells * process.cell);
  Vec3i last;
  for (int axis = 0; axis < 3; ++axis) {
    last[axis] = static_cast<int>(std::ceil(process.cells * extent[axis]));
  }
  TriangleMesh rods, balls;
  for (int k = -1; k <= last.z; ++k) {
    for (int j = -1; j <= last.y; ++j) {
      for (int i = -1; i <= last.x; ++i) {
        append(balls, makeSphere(node(i, j, k), process.ballRadius, 6));
        if (i < last.x)
          append(rods, makeCapsule(node(i, j, k), node(i + 1, j, k), process.rodRadius, 20));
        if (j < last.y)
          append(rods, makeCapsule(node(i, j, k), node(i, j + 1, k), process.rodRadius, 20));
        if (k < last.z)
          append(rods, makeCapsule(node(i, j, k), node(i, j, k + 1), process.rodRadius, 20));
      }
    }
  }
  setMaterial(
      rods,
      {.name = "copper", .baseColor = {0.72f, 0.38f, 0.26f, 1}, .metallic = 1, .roughness = 0.4f});
  setMaterial(
      balls,
      {.name = "brass", .baseColor = {0.74f, 0.58f, 0.26f, 1}, .metallic = 1, .roughness = 0.35f});
  sample.mesh = std::move(rods);
  append(sample.mesh, balls);
  return sample;
}

}  // namespace exemplar
