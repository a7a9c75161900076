// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

// The weave of least risk, found by a search over tilt and pitches for the largest clearance of
// linked rings: columns 2.5 ring radii apart, rows 0.7, tilt 30 degrees; middles of wires stay 0.46
// apart.
constexpr double kColumnPitch = 2.5, kRowPitch = 0.7;

}  // namespace

ProcessSample makeChainmail(const ChainmailProcess& process, const Vec3d& extent,
                            std::uint64_t seed, const Progress& progress) {
  const Random random(seed, stream::kChainmail);
  const double r = process.ringRadius;
  const double pitchX = kColumnPitch * r, pitchY = kRowPitch * r;
  const double half = r * std::sin(process.tilt) + process.wireRadius;
  const double air = 2;
  ProcessSample sample;
  sample.box.min = {0, 0, -half - air};
  sample.box.max = {process.columns * pitchX * extent.x, process.rows * pitchY * extent.y,
                    half + air};

  const Material steel{
      .name = "steel", .baseColor = {0.56f, 0.57f, 0.58f, 1}, .metallic = 1, .roughness = 0.35f};
  // Rings that reach into the window have their centers within a ring of it.
  const int margin = 3;
  const int columns = static_cast<int>(std::ceil(process.columns * extent.x)) + margin;
  const int rows = static_cast<int>(std::ceil(process.rows * extent.y)) + 2 * margin;
  for (int row = -2 * margin; row < rows; ++row) {
    progress.report("weaving rings", static_cast<double>(row + 2 * margin) / (rows + 2 * margin));
    for (int column = -margin; column < columns; ++column) {
      const std::uint64_t key = static_cast<std::uint64_t>(row + 1000) * 100000 + (column + 1000);
      const auto jitter = [&](int draw) {
        return random.uniform(-1, 1, key, draw) * process.jitter;
      };
      const bool odd = row & 1;
      const Vec3d center{(column + (odd ? 0.75 : 0.25)) * pitchX + jitter(0) * r,
                         (row + 0.5) * pitchY + jitter(1) * r, jitter(2) * r};
      const double tilt = (odd ? -1 : 1) * process.tilt + jitter(3);
      const double lean = jitter(4);
      append(sample.mesh, makeTorus(center, {lean, -std::sin(tilt), std::cos(tilt)}, r,
                                    process.wireRadius, 64, 16));
    }
  }
  setMaterial(sample.mesh, steel);
  return sample;
}

}  // namespace exemplar
