// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/figure_constants.h"
#include "core/progress.h"
#include "measure/patch_distance.h"
#include "measure/patch_likeness.h"
#include "measure/pieces.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct LikenessOptions {
  double threshold = kLikenessThreshold;  ///< the IoU above which windows count as alike; 0..1
  int windows = 1000;                     ///< windows drawn for each figure; >= 1
  std::uint64_t seed = 0;
  /// The result's field was measured from a contoured surface (`sampleMeshResult`), where bodies
  /// that rest on each other have become one.
  bool contoured = false;
};

/// How much a result is like its example. A figure that has no meaning (a ratio to an example
/// without solid, interior windows of a volume thinner than a window) is not there.
struct Likeness {
  PatchLikeness published;  ///< LP-published: for comparison with published work only
  PatchLikeness dense;      ///< LP-dense: how much of the result the example has
  PatchLikeness coverage;   ///< how much of the example the result has
  /// The same two over windows wholly inside, which no cut at the box's faces makes alike.
  std::optional<PatchLikeness> denseInterior, coverageInterior;
  std::optional<PatchDistance> patches;                ///< FPD and its floor
  double exampleOccupancy = 0, resultOccupancy = 0;    ///< solid shares, 0..1
  double exampleSurface = 0, resultSurface = 0;        ///< area densities, 1 / voxels
  std::optional<double> occupancyRatio, surfaceRatio;  ///< the result's over the example's
  /// Nothing where the example's pieces rest on each other and the result was contoured.
  std::optional<Pieces> pieces;
};

/// All figures of likeness, from the fields alone. At 128³ about a second on two cores; the same
/// bytes at any number of threads. Throws `InputError` where the fields' voxel sizes differ or one
/// has no samples, and `Cancelled`.
Likeness measureLikeness(const DistanceField& example, const DistanceField& result,
                         const LikenessOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
