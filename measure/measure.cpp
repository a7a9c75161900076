// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/measure.h"

namespace exemplar {

std::string frontierName(Frontier frontier) {
  switch (frontier) {
    case Frontier::NewAndAlike:
      return "new_and_alike";
    case Frontier::Copied:
      return "copied";
    case Frontier::Strange:
      return "strange";
    case Frontier::Neither:
      break;
  }
  return "neither";
}

Measures measure(const DistanceField& example, const DistanceField& result,
                 const MeasureInput& input, const MeasureOptions& options,
                 const Progress& progress) {
  Measures m;
  m.likeness = measureLikeness(example, result, options.likeness, progress.part(0, 0.4));
  m.multiscale =
      multiscaleDistance(example, result, {.seed = options.likeness.seed}, progress.part(0.4, 0.5));
  m.wholeness = measureWholeness(Occupancy(example), Occupancy(result), progress.part(0.5, 0.53));
  m.landmarks = countLandmarks(Occupancy(example), Occupancy(result),
                               {.seed = options.likeness.seed}, progress.part(0.53, 0.55));
  m.novelty = measureNovelty(example, result, input.origins, options.exampleIndex,
                             progress.part(0.55, 0.7));
  if (m.multiscale) {
    const Axes fills = m.novelty.rollingIsFair;
    const bool alike = m.multiscale->ratio <= (fills.x && fills.y ? kAlikeMaterial : kAlike);
    const bool isNew = m.novelty.rolled.distance >= kNew;
    m.frontier = alike ? (isNew ? Frontier::NewAndAlike : Frontier::Copied)
                       : (isNew ? Frontier::Strange : Frontier::Neither);
  }
  m.seams =
      measureSeams(example, result, input.origins, options.exampleIndex, progress.part(0.7, 0.8));
  progress.report("checking the mesh", 0.8);
  if (input.mesh)
    m.mesh = meshHealth(*input.mesh, {.selfIntersections = true}, progress.part(0.8, 1));

  const Likeness& l = m.likeness;
  m.signs = {.exampleOccupancy = l.exampleOccupancy,
             .resultOccupancy = l.resultOccupancy,
             .exampleSurface = l.exampleSurface,
             .resultSurface = l.resultSurface,
             .usedShare = m.novelty.usedShare,
             .likeness = l.dense.share,
             .coverage = l.coverage.share};
  m.collapse = detectCollapse(m.signs);
  m.doubts = doubtsOf({.wholeness = m.wholeness,
                       .rolled = m.novelty.rolled,
                       .rollingIsFair = m.novelty.rollingIsFair,
                       .landmarks = m.landmarks,
                       .exampleSize = example.size(),
                       .resultSize = result.size(),
                       .exampleOccupancy = l.exampleOccupancy,
                       .resultOccupancy = l.resultOccupancy});
  progress.report("measured", 1);
  return m;
}

}  // namespace exemplar
