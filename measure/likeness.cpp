// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/likeness.h"

#include "measure/occupancy.h"
#include "measure/same_voxels.h"

namespace exemplar {

Likeness measureLikeness(const DistanceField& example, const DistanceField& result,
                         const LikenessOptions& options, const Progress& progress) {
  progress.report("measuring likeness", 0);
  requireSameVoxels(example, result);
  const Occupancy e(example), r(result);
  const auto patches = [&](const Occupancy& asked, const Occupancy& reference, int stride,
                           WindowBorder border, double from, double to) {
    PatchLikenessOptions o;
    o.border = border;
    o.referenceStride = stride;
    o.threshold = options.threshold;
    o.windows = options.windows;
    o.averaged = border == WindowBorder::Padded && stride == 1 ? o.averaged : 0;
    o.seed = options.seed;
    return patchLikeness(asked, reference, o, progress.part(from, to));
  };

  Likeness likeness;
  likeness.published = patches(r, e, kLikenessStride, WindowBorder::Padded, 0, 0.05);
  likeness.dense = patches(r, e, 1, WindowBorder::Padded, 0.05, 0.25);
  likeness.coverage = patches(e, r, 1, WindowBorder::Padded, 0.25, 0.45);
  if (hasInteriorWindows(e.size()) && hasInteriorWindows(r.size())) {
    likeness.denseInterior = patches(r, e, 1, WindowBorder::Interior, 0.45, 0.6);
    likeness.coverageInterior = patches(e, r, 1, WindowBorder::Interior, 0.6, 0.75);
  }
  PatchDistanceOptions distance;
  distance.seed = options.seed;
  likeness.patches = patchDistance(example, result, distance, progress.part(0.75, 0.9));

  progress.report("measuring surface", 0.9);
  likeness.exampleOccupancy = solidFraction(e);
  likeness.resultOccupancy = solidFraction(r);
  likeness.exampleSurface = surfaceDensity(e);
  likeness.resultSurface = surfaceDensity(r);
  if (likeness.exampleOccupancy > 0)
    likeness.occupancyRatio = likeness.resultOccupancy / likeness.exampleOccupancy;
  if (likeness.exampleSurface > 0)
    likeness.surfaceRatio = likeness.resultSurface / likeness.exampleSurface;
  const Pieces pieces = comparePieces(example, result, progress.part(0.92, 1));
  if (pieces.depth == 0 || !options.contoured) likeness.pieces = pieces;
  return likeness;
}

}  // namespace exemplar
