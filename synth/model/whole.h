// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"

namespace exemplar {

/// How labeling a network ended.
struct Labeling {
  Outcome outcome = Outcome::Unfinished;
  std::vector<Label> labels;  ///< one for each cell where Complete; else empty
  double share = 1;           ///< of the work that was done, 0..1
};

/// Labels the whole network in one pass (thesis, Algorithm 3.1) over arc-consistent sets `base`,
/// cell after cell. A label that leaves some cell without any is taken back at once. Where a cell
/// loses all of its labels in this way, the region around it (`Region`) is taken back and
/// relabeled, by search and then exactly; the region grows until that succeeds.
///
/// With `plain`, cells take the label that is most frequent in the examples of those left, not one
/// at random: mostly ground and air, soon labeled.
///
/// With `patience`, ends Unfinished where all repairs so far take more than that many times the
/// work of labeling a hundred thousand cells and a quarter of those done so far: the time is then
/// linear in cells, and regions do not grow past what this allows. Work is counted, not timed, so
/// that it ends at the same cell on every machine. Impossible where the region has grown to
/// everything and the exact solver proves that nothing fits; Unfinished where it could not decide.
/// Throws `Cancelled`.
Labeling labelWhole(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                    ModelStatistics& statistics, const Progress& progress,
                    std::optional<int> patience = std::nullopt, bool plain = false);

}  // namespace exemplar
