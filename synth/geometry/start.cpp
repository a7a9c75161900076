// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/start.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "synth/geometry/level_seams.h"
#include "synth/geometry/quilt.h"
#include "synth/geometry/rearrange.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kStartStream = 0x0b71;
/// Samples along the longest side of the coarsest level, about.
constexpr int kCoarsestSide = 16;
/// A quilt is made where the example has at most this many samples along its longest side.
constexpr int kQuiltSide = 40;
/// Ground that rises by more than this from one side to the other slopes, voxels.
constexpr double kSlope = 1;
/// How far parts of an object that keeps its size may move along it, of its length.
constexpr double kObjectShift = 0.16;
/// How often a block that may not be copied is drawn again; the second half of times from anywhere.
constexpr std::uint32_t kDraws = 32;
/// A repetition is stretched, so that a result holds a whole number of it, where what is an example
/// apart moves by no more than this, samples of the coarsest level.
constexpr double kStretch = 0.75;

/// A sample's place along an axis on which the example is not stationary.
int proportional(int p, int target, int source) {
  return target <= 1
             ? 0
             : static_cast<int>(std::llround(static_cast<double>(p) * (source - 1) / (target - 1)));
}

/// Whether an example is ground: solid all over its lowest layer, air all over its highest.
bool isGround(const DistanceField& example) {
  const Vec3i n = example.size();
  for (int j = 0; j < n.y; ++j) {
    for (int i = 0; i < n.x; ++i) {
      if (!(example.values(i, j, 0) < 0) || example.values(i, j, n.z - 1) < 0) return false;
    }
  }
  return true;
}

/// How much higher a ground is at one side than at the opposite one, along x or y, whichever is
/// more: means over an eighth of its length, voxels.
double slopeOf(const DistanceField& ground) {
  const Vec3i n = ground.size();
  double slope = 0;
  for (const int axis : {0, 1}) {
    const int reach = std::max(1, n[axis] / 8);
    std::int64_t low = 0, high = 0;
    for (std::size_t s = 0; s < ground.values.count(); ++s) {
      if (!(ground.values.values()[s] < 0)) continue;
      const int at = ground.values.ijk(s)[axis];
      low += at < reach;
      high += at >= n[axis] - reach;
    }
    const double columns = static_cast<double>(reach) * n[1 - axis];
    slope = std::max(slope, std::abs(static_cast<double>(high - low)) / columns);
  }
  return slope;
}

}  // namespace

int randomStartLevels(const DistanceField& example) {
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  int levels = 1;
  while ((longest >> levels) >= kCoarsestSide && levels < 8) ++levels;
  return levels;
}

int quiltLevels(const DistanceField& example) {
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  int levels = 1;
  while (levels < 8 && (longest >> (levels - 1)) > kQuiltSide) ++levels;
  return levels;
}

bool isSlopingGround(const DistanceField& example) {
  return isGround(example) && slopeOf(example) > kSlope;
}

PyramidSources startFromRandomBlocks(const PyramidLevel& level, const StationaryAxes& stationary,
                                     std::uint64_t seed) {
  const Random random(seed, kStartStream);
  const Vec3i size = level.framedTarget();
  const Vec3i block = max(level.patch, Vec3i{2, 2, 2});
  const Vec3i blocks{(size.x + block.x - 1) / block.x, (size.y + block.y - 1) / block.y,
                     (size.z + block.z - 1) / block.z};
  const auto parts = static_cast<std::uint32_t>(level.first.size());
  PyramidSources sources(size);
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    const std::uint64_t key =
        (static_cast<std::uint64_t>(p.z / block.z) * blocks.y + p.y / block.y) * blocks.x +
        p.x / block.x;
    for (std::uint32_t draw = 0; draw < 4 * kDraws; draw += 4) {
      const std::uint32_t part = parts == 1 ? 0 : random.below(parts, key, draw + 3);
      const Vec3i source = level.partSize[part] + level.low + level.high;
      const Vec3i corner = level.first[part] - level.low;
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
      sources[p] = cell + corner;
      if (level.allowed.empty() || level.allowed[level.allowed.clamped(first + corner)]) break;
    }
  }
  return sources;
}

Repetition repetitionOf(const PyramidLevel& level) {
  Array3D<float> example(level.partSize[0]);
  for (std::size_t s = 0; s < example.count(); ++s) {
    example.values()[s] = level.source[example.ijk(s) + level.first[0]];
  }
  Repetition repetition = findRepetition(example);
  for (int axis = 0; axis < 3; ++axis) {
    if (!level.periodic[axis]) continue;
    const int length = level.targetSize[axis], apart = level.partSize[0][axis];
    if (!repetition.stretch(axis, length, apart, kStretch)) return {};
  }
  return repetition;
}

void keepInStep(const PyramidLevel& level, const Repetition& repetition, PyramidSources& sources) {
  if (!repetition.any()) return;
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    const Vec3i step = repetition.nearest(sources.values()[s] - p - level.inPlace());
    sources.values()[s] = level.source.clamped(p + level.inPlace() + step);
  }
}

PyramidSources startFromQuilt(const PyramidLevel& level, const StationaryAxes& stationary,
                              const Repetition& repetition, std::uint64_t seed, float air,
                              const Progress& progress) {
  QuiltOptions quilting;
  quilting.seed = seed;
  quilting.window = blockWindow(level, stationary);
  quilting.repetition = repetition;
  quilting.cut = [&](PyramidSources& sources) {
    Array3D<float> target = gather(level, sources);
    pinTarget(level, air, target);
    cutSeams(level, target, sources, progress);
  };
  return quilt(level, quilting, progress);
}

PyramidSources startFromHalves(const PyramidLevel& level, int l, const StationaryAxes& stationary,
                               std::uint64_t seed, float air, const Progress& progress) {
  RearrangeOptions rearranging;
  rearranging.seed = seed;
  rearranging.stationary = stationary;
  rearranging.window = std::max(2, rearranging.window >> l);
  rearranging.cut = [&](PyramidSources& sources) {
    Array3D<float> target = gather(level, sources);
    pinTarget(level, air, target);
    cutJoints(level, target, rearranging.window, sources, progress);
  };
  return rearrange(level, rearranging, progress);
}

int placeWindow(const PyramidLevel& level, int axis) {
  const double source = level.partSize[0][axis];
  const double stretch = std::abs(level.targetSize[axis] / source - 1);
  return std::max(1, static_cast<int>(source * std::clamp(stretch / 4, 1.0 / 32, 1.0 / 4)));
}

Vec3i blockWindow(const PyramidLevel& level, const StationaryAxes& stationary) {
  const Vec3i n = level.partSize[0];
  const int longest = std::max({n.x, n.y, n.z});
  Vec3i window;
  for (int axis = 0; axis < 3; ++axis) {
    const bool object = level.low[axis] > 0 && level.high[axis] > 0;
    // Air above, say, and below what the box cuts off: parts that moved would lose their ground.
    const bool stands = (level.low[axis] > 0) != (level.high[axis] > 0);
    if (stands && level.targetSize[axis] == n[axis]) {
      window[axis] = 0;
    } else if (object && level.targetSize[axis] == n[axis]) {
      const bool thin = 2 * n[axis] < longest;
      window[axis] = thin ? 0 : static_cast<int>(std::lround(n[axis] * kObjectShift));
    } else {
      window[axis] = stationary[axis] ? -1 : placeWindow(level, axis);
    }
  }
  return window;
}

Vec3i patchWindow(const PyramidLevel& level, const StationaryAxes& stationary) {
  Vec3i window = blockWindow(level, stationary);
  for (int axis = 0; axis < 3; ++axis) {
    if (window[axis] < 0) continue;
    const double n = level.partSize[0][axis];
    const double stretch = std::abs(1 - n / level.targetSize[axis]);
    window[axis] += 1 + static_cast<int>(std::ceil(stretch * n / 2));
  }
  return window;
}

}  // namespace exemplar
