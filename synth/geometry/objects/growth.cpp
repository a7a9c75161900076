// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/growth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/cells.h"
#include "core/parallel.h"
#include "sdf/resample.h"
#include "synth/geometry/voting/voting.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Voting starts first on the finest level on which the example's longest side has at most so many
/// samples.
constexpr int kCoarseSide = 40;

/// Solids are near each other up to so many voxels. What has grown is as wanted if so much of it
/// and of the stretched example is near the other; else it is made again from a finer level.
constexpr float kNear = 3;
constexpr double kAgree = 0.75;

Vec3i sizeOf(const GrowthOptions& options) {
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis)
    size[axis] = static_cast<int>(options.places[static_cast<std::size_t>(axis)].size());
  return size;
}

double placeAt(const GrowthOptions& options, int axis, int i) {
  return options.places[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)];
}

/// The example as it is stretched, in voxels.
Array3D<float> stretchedValues(const DistanceField& example, const GrowthOptions& options) {
  Array3D<float> values(sizeOf(options));
  parallelForEachCell(values.size(), [&](const Vec3i& p) {
    const Vec3d at{placeAt(options, 0, p.x), placeAt(options, 1, p.y), placeAt(options, 2, p.z)};
    values[p] = static_cast<float>(cubicAt(example.values, at) / example.voxelSize);
  });
  return values;
}

/// The start of voting on a grid `shrink` times as coarse.
Array3D<Vec3i> startOf(const GrowthOptions& options, int shrink) {
  const Vec3i size = sizeOf(options);
  Vec3i coarse;
  for (int axis = 0; axis < 3; ++axis) coarse[axis] = (size[axis] + shrink - 1) / shrink;
  Array3D<Vec3i> start(coarse);
  parallelForEachCell(coarse, [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      const int middle = std::min(p[axis] * shrink + shrink / 2, size[axis] - 1);
      const auto place = static_cast<int>(std::lround(placeAt(options, axis, middle)));
      start[p][axis] = place / shrink;
    }
  });
  return start;
}

/// How much of the one's solid is near the other's, the lesser of both ways; fields in voxels.
double agreement(const Array3D<float>& stretched, const DistanceField& made) {
  const float near = kNear * static_cast<float>(made.voxelSize);
  std::int64_t wanted = 0, found = 0, there = 0, asked = 0;
  for (std::size_t s = 0; s < stretched.count(); ++s) {
    const float one = stretched.values()[s], other = made.values.values()[s];
    wanted += one < 0;
    found += one < 0 && other < near;
    there += other < 0;
    asked += other < 0 && one < kNear;
  }
  const auto share = [](std::int64_t part, std::int64_t all) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::int64_t>(1, all));
  };
  return std::min(share(found, wanted), share(asked, there));
}

}  // namespace

SynthesisResult growObject(const DistanceField& example, const GrowthOptions& options,
                           const Progress& progress) {
  const Vec3i n = example.size();
  VotingOptions voting;
  voting.size = sizeOf(options);
  voting.seed = options.seed;
  voting.truncation = options.truncation;
  voting.stationary = Axes{};
  voting.guide = stretchedValues(example, options);
  int levels = 1;
  while ((std::max({n.x, n.y, n.z}) >> (levels - 1)) > kCoarseSide) ++levels;
  SynthesisResult best;
  double most = -1;
  for (double done = 0; levels > 0 && most < kAgree; --levels) {
    voting.levels = levels;
    voting.start = startOf(options, 1 << (levels - 1));
    const double next = levels > 1 ? (1 + done) / 2 : 1;
    SynthesisResult made = synthesizeByVoting(example, voting, progress.part(done, next));
    done = next;
    const double agrees = agreement(*voting.guide, made.field);
    if (agrees <= most) continue;
    most = agrees;
    best = std::move(made);
  }
  return best;
}

}  // namespace exemplar
