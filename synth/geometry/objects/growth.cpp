// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/growth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"
#include "sdf/resample.h"
#include "synth/geometry/objects/object_kind.h"
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

/// A sample is shown from at most so far from where the stretched object is, samples.
constexpr int kOriginReach = 4;

/// What has grown is made again, with its guide moved outward or inward, while its solid share is
/// off by more than this, at most so many times; before that on the coarsest level alone, up to so
/// many times, which takes so much of the work.
constexpr double kSolidOff = 0.07;
constexpr int kCorrections = 1, kCalibrations = 3;
constexpr double kCalibrated = 0.15;

/// The start of voting on a grid `shrink` times as coarse.
Array3D<Vec3i> startOf(const StretchedObject& stretched, const Vec3i& example, int shrink) {
  const Vec3i size = stretched.places.size();
  Vec3i coarse, last;
  for (int axis = 0; axis < 3; ++axis) {
    coarse[axis] = (size[axis] + shrink - 1) / shrink;
    last[axis] = (example[axis] + shrink - 1) / shrink - 1;
  }
  Array3D<Vec3i> start(coarse);
  parallelForEachCell(coarse, [&](const Vec3i& p) {
    const Vec3i middle = p * shrink + Vec3i{shrink / 2, shrink / 2, shrink / 2};
    const Vec3f place = stretched.places[stretched.places.clamped(middle)];
    for (int axis = 0; axis < 3; ++axis) {
      const auto sample = static_cast<int>(std::lround(place[axis]));
      start[p][axis] = std::clamp(sample / shrink, 0, last[axis]);
    }
  });
  return start;
}

/// The sample of the example nearest to a place that is on the same side of the surface, or just
/// the nearest.
Vec3i originOf(const Array3D<float>& example, const Vec3f& place, bool solid) {
  Vec3i middle;
  for (int axis = 0; axis < 3; ++axis) middle[axis] = static_cast<int>(std::lround(place[axis]));
  middle = example.clamped(middle);
  if ((example[middle] < 0) == solid) return middle;
  Vec3i best = middle;
  float least = std::numeric_limits<float>::infinity();
  forEachCell(CellBox{middle, middle + Vec3i{1, 1, 1}}.grown(kOriginReach), [&](const Vec3i& p) {
    if (!example.contains(p) || (example[p] < 0) != solid) return;
    const Vec3f way = cast<float>(p) - place;
    const float distance = dot(way, way);
    if (distance >= least) return;
    least = distance;
    best = p;
  });
  return best;
}

/// The stretched object as it is.
SynthesisResult shown(const DistanceField& example, const StretchedObject& object) {
  SynthesisResult made;
  made.field = {Array3D<float>(object.values.size()), example.voxelSize, example.origin,
                example.truncation};
  made.origins = Origins(object.values.size());
  const auto voxel = static_cast<float>(example.voxelSize);
  parallelForEachCell(object.values.size(), [&](const Vec3i& p) {
    float value = std::clamp(object.values[p] * voxel, -example.truncation, example.truncation);
    const Vec3i cell = originOf(example.values, object.places[p], value < 0);
    // Where there is no such sample, the surface gives way.
    const bool solid = example.values[cell] < 0;
    if (solid != (value < 0)) value = solid ? -voxel / 64 : voxel / 64;
    made.field.values[p] = value;
    made.origins[p] = Origin(cell, 0, 0);
  });
  return made;
}

/// How much of the one's solid is near the other's, the lesser of both ways; the first in voxels.
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

/// An object that grows.
class Growing {
 public:
  Growing(const DistanceField& example, const GrowthOptions& options)
      : example_(example), options_(options) {
    const Vec3i n = example.size();
    while ((std::max({n.x, n.y, n.z}) >> (levels_ - 1)) > kCoarseSide) ++levels_;
    voting_.seed = options.seed;
    voting_.truncation = options.truncation;
    voting_.stationary = Axes{};
  }

  SynthesisResult run(const Progress& progress) {
    progress.report("stretching the object", 0);
    ObjectKind kind = objectKind(example_);
    // Parts that are repeated along an axis have no one place on it.
    if (kind == ObjectKind::Limbs && !std::ranges::all_of(options_.places, isInOrder))
      kind = ObjectKind::Planes;
    const Progress first = progress.part(0, kind == ObjectKind::Lump ? 0.1 : 1);
    stretched_ = kind == ObjectKind::Limbs ? stretchSkeleton(example_, options_.places, first)
                                           : stretchSpace(example_, options_.places, first);
    if (kind != ObjectKind::Lump) return shown(example_, stretched_);
    voting_.size = stretched_.values.size();
    SynthesisResult best;
    double most = -1;
    for (double done = 0.1; levels_ > 0 && most < kAgree; --levels_) {
      const double next = levels_ > 1 ? (1 + done) / 2 : 1;
      SynthesisResult made = asSolid(progress.part(done, next));
      done = next;
      const double agrees = agreement(stretched_.values, made.field);
      if (agrees <= most) continue;
      most = agrees;
      best = std::move(made);
    }
    return best;
  }

 private:
  /// Grown from the level, with about as much solid as the example has.
  SynthesisResult asSolid(const Progress& progress) {
    const int shrink = 1 << (levels_ - 1);
    voting_.levels = levels_;
    voting_.start = startOf(stretched_, example_.size(), shrink);
    voting_.guide = stretched_.values;
    SynthesisResult best;
    double least = std::numeric_limits<double>::infinity(), aim = 1;
    for (int made = 0; made <= kCorrections && least > kSolidOff; ++made) {
      const Progress part = progress.part(static_cast<double>(made) / (kCorrections + 1),
                                          (made + 1.0) / (kCorrections + 1));
      calibrate(shrink, aim, part.part(0, kCalibrated));
      SynthesisResult next = synthesizeByVoting(example_, voting_, part.part(kCalibrated, 1));
      const Solid solid = solidOf(next.field);
      // Finer levels add about as much each time.
      aim /= std::max(0.1, solid.ratio);
      if (shrink == 1) moveGuide(solid.depth);
      if (std::abs(solid.ratio - 1) >= least) continue;
      least = std::abs(solid.ratio - 1);
      best = std::move(next);
    }
    return best;
  }

  /// Moves the guide until the coarsest level alone, which costs little, has `aim` times as much
  /// solid as the example.
  void calibrate(int shrink, double aim, const Progress& progress) {
    if (shrink == 1) return;
    const DistanceField coarse = blockAverage(example_, shrink);
    for (int round = 0; round < kCalibrations; ++round) {
      VotingOptions voting = voting_;
      voting.levels = 1;
      voting.size = voting.start.size();
      DistanceField guide;
      guide.values = *voting_.guide;
      voting.guide = blockAverage(guide, shrink).values;
      for (float& v : voting.guide->values()) v /= static_cast<float>(shrink);
      const SynthesisResult made = synthesizeByVoting(
          coarse, voting,
          progress.part(static_cast<double>(round) / kCalibrations, (round + 1.0) / kCalibrations));
      const Solid solid = solidOf(made.field, aim);
      if (std::abs(solid.ratio - 1) < kSolidOff / 2) return;
      moveGuide(solid.depth * shrink);
    }
  }

  struct Solid {
    double ratio = 1;  ///< of its share, over the example's
    double depth = 0;  ///< how far its surface is outside of where it should be, voxels
  };
  /// Compared with `aim` times what the example has.
  Solid solidOf(const DistanceField& made, double aim = 1) const {
    std::int64_t wanted = 0, solid = 0, surface = 0;
    for (const float v : example_.values.values()) wanted += v < 0;
    const auto voxel = static_cast<float>(made.voxelSize);
    for (const float v : made.values.values()) {
      solid += v < 0;
      surface += std::abs(v) < voxel;
    }
    const double larger =
        static_cast<double>(made.values.count()) / static_cast<double>(example_.values.count());
    const double all = std::max(1.0, aim * static_cast<double>(wanted) * larger);
    // The surface takes up two voxels.
    const double area = std::max(1.0, static_cast<double>(surface) / 2);
    return {static_cast<double>(solid) / all, (static_cast<double>(solid) - all) / area};
  }
  /// By so many voxels inward.
  void moveGuide(double depth) {
    for (float& v : voting_.guide->values()) v += static_cast<float>(depth);
  }

  const DistanceField& example_;
  const GrowthOptions& options_;
  VotingOptions voting_;
  StretchedObject stretched_;
  int levels_ = 1;
};

}  // namespace

SynthesisResult growObject(const DistanceField& example, const GrowthOptions& options,
                           const Progress& progress) {
  return Growing(example, options).run(progress);
}

}  // namespace exemplar
