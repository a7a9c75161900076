// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/measure.h"

namespace exemplar {

Measures measure(const DistanceField& example, const DistanceField& result,
                 const MeasureInput& input, const MeasureOptions& options,
                 const Progress& progress) {
  Measures m;
  const auto begin = [&](const char* stage, double fraction) {
    progress.report(stage, fraction);
    if (progress.cancelled()) m.status = MeasureStatus::Cancelled;
    return m.status == MeasureStatus::Complete;
  };

  if (!begin("measuring likeness", 0)) return m;
  m.likeness = measureLikeness(example, result, options.likeness);
  if (!begin("measuring novelty", 0.5)) return m;
  m.novelty = measureNovelty(example, result, input.origins, options.exampleIndex);
  if (!begin("measuring seams", 0.7)) return m;
  m.seams = measureSeams(example, result, input.origins, options.exampleIndex);
  if (!begin("checking the mesh", 0.8)) return m;
  if (input.mesh) m.mesh = meshHealth(*input.mesh, {.selfIntersections = true});

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
