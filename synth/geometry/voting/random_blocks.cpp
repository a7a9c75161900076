// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/voting/random_blocks.h"

#include <algorithm>
#include <cmath>

#include "core/cells.h"
#include "core/random.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Samples along the longest side of the coarsest level, about.
constexpr int kCoarsestSide = 16;
/// How often a block that may not be copied is drawn again; the second half of times from anywhere.
constexpr std::uint32_t kDraws = 32;

/// A sample's place along an axis on which the example is not stationary.
int proportional(int p, int target, int source) {
  return target <= 1
             ? 0
             : static_cast<int>(std::llround(static_cast<double>(p) * (source - 1) / (target - 1)));
}

}  // namespace

int randomBlockLevels(const DistanceField& example) {
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  int levels = 1;
  while ((longest >> levels) >= kCoarsestSide && levels < 8) ++levels;
  return levels;
}

PyramidSources randomBlocks(const PyramidLevel& level, const Axes& stationary, std::uint64_t seed,
                            const std::function<PartRange(const Vec3i&)>& partsAt) {
  const Random random(seed, stream::kSmallBlocks);
  const Array3D<std::uint8_t>& matchable = level.source.matchable;
  const Vec3i size = level.target.framed();
  const Vec3i block = max(level.patch, Vec3i{2, 2, 2});
  const Vec3i blocks{(size.x + block.x - 1) / block.x, (size.y + block.y - 1) / block.y,
                     (size.z + block.z - 1) / block.z};
  PyramidSources sources(size);
  parallelForEachCell(size, [&](const Vec3i& p) {
    const std::uint64_t key =
        (static_cast<std::uint64_t>(p.z / block.z) * blocks.y + p.y / block.y) * blocks.x +
        p.x / block.x;
    const PartRange parts = partsAt(p);
    for (std::uint32_t draw = 0; draw < 4 * kDraws; draw += 4) {
      const std::uint32_t part =
          parts.first + (parts.count == 1 ? 0 : random.below(parts.count, key, draw + 3));
      const CellBox framed = level.source.framed(part);
      const Vec3i source = framed.size();
      Vec3i cell, first;
      for (int axis = 0; axis < 3; ++axis) {
        const int within = p[axis] % block[axis];
        if (stationary[axis] || draw >= 2 * kDraws) {
          const int range = std::max(1, source[axis] - block[axis] + 1);
          first[axis] = static_cast<int>(random.below(range, key, draw + axis));
          cell[axis] = first[axis] + within;
        } else {
          cell[axis] = proportional(p[axis], size[axis], source[axis]);
          first[axis] = proportional(p[axis] - within, size[axis], source[axis]);
        }
        cell[axis] = std::clamp(cell[axis], 0, source[axis] - 1);
      }
      sources[p] = cell + framed.begin;
      if (matchable.empty() || matchable[matchable.clamped(first + framed.begin)]) break;
    }
  });
  return sources;
}

}  // namespace exemplar
