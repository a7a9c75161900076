// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/measure.h"

namespace exemplar {

Measures measure(const DistanceField& example, const DistanceField& result,
                 const MeasureInput& input, const MeasureOptions& options,
                 const Progress& progress) {
  Measures m;
  m.likeness = measureLikeness(example, result, options.likeness, progress.part(0, 0.5));
  m.novelty =
      measureNovelty(example, result, input.origins, options.exampleIndex, progress.part(0.5, 0.7));
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
  progress.report("measured", 1);
  return m;
}

}  // namespace exemplar
