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

constexpr std::array<float, 4> kSkin{0.035f, 0.05f, 0.04f, 1};

/// From the root of a scale (0) to its tip (1), which is lighter, and more golden the older it is.
std::array<float, 4> scaleColor(double tip, double age) {
  const auto mix = [&](double root, double end) {
    return static_cast<float>(root + (end - root) * tip * tip);
  };
  return {mix(0.02, 0.10 + 0.32 * age), mix(0.09, 0.30 + 0.06 * age), mix(0.06, 0.13 - 0.07 * age),
          1};
}

/// A shield about the origin, its tip toward -y, of half a width and length: pointed, with a keel
/// along its back.
TriangleMesh makeShield(const Vec3d& half) {
  TriangleMesh shield = makeSphere({}, 1, 12);
  for (Vec3d& p : shield.positions) {
    const double narrowing = p.y < 0 ? 1 - 0.5 * p.y * p.y : 1;
    const double keel = p.z > 0 ? 0.8 * p.z * std::max(0.0, 1 - 3 * std::abs(p.x)) : 0;
    p = {half.x * narrowing * p.x, half.y * p.y, half.z * (p.z + keel)};
  }
  return shield;
}

}  // namespace

ProcessSample makeScales(const ScalesProcess& process, const Vec3d& extent, std::uint64_t seed,
                         const Progress& progress) {
  const Random random(seed, stream::kScales);
  const Vec3d half{0.56 * process.width, 1.1 * process.length, 0.15 * process.width};
  const double skin = 5, air = 2;
  ProcessSample sample;
  sample.box.min = {0, 0, -skin};
  sample.box.max = {process.columns * process.width * extent.x,
                    process.rows * process.length * extent.y,
                    std::ceil(2 * half.z + half.y * std::sin(process.lift) + air)};

  const double margin = 2 * process.width;
  sample.mesh = makeBox(
      {{-margin, -margin, -4 * skin}, {sample.box.max.x + margin, sample.box.max.y + margin, 0}});
  sample.mesh.colors.assign(sample.mesh.positions.size(), kSkin);

  const int columns = static_cast<int>(std::ceil(process.columns * extent.x)) + 2;
  const int rows = static_cast<int>(std::ceil(process.rows * extent.y)) + 3;
  const double sine = std::sin(process.lift), cosine = std::cos(process.lift);
  for (int row = -3; row < rows; ++row) {
    progress.report("growing scales", static_cast<double>(row + 3) / (rows + 3));
    for (int column = -2; column < columns; ++column) {
      const std::uint64_t key = static_cast<std::uint64_t>(row + 1000) * 100000 + (column + 1000);
      const auto jitter = [&](std::uint32_t draw) {
        return random.uniform(-1, 1, key, draw) * process.jitter;
      };
      const Vec3d middle{(column + (row & 1 ? 1.0 : 0.5) + jitter(0)) * process.width,
                         (row + 0.5) * process.length + jitter(1) * process.width, 0.5 * half.z};
      const double turn = jitter(2), size = 1 + jitter(3);
      const double age = random.uniform(0, 1, key, 4);
      TriangleMesh scale = makeShield(size * half);
      for (Vec3d& p : scale.positions) {
        scale.colors.push_back(scaleColor(0.5 - 0.5 * p.y / (size * half.y), age));
        p = {p.x - turn * p.y, p.y + turn * p.x, p.z};
        p = middle + Vec3d{p.x, cosine * p.y + sine * p.z, cosine * p.z - sine * p.y};
      }
      append(sample.mesh, scale);
    }
  }
  setMaterial(sample.mesh,
              {.name = "scales", .baseColor = {1, 1, 1, 1}, .metallic = 0.2f, .roughness = 0.4f});
  return sample;
}

}  // namespace exemplar
