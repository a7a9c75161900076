// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"

namespace exemplar {

/// What a way of labelling a network came to. `labels`, one a cell, is there where Complete.
struct Labelling {
  ModelStatus status = ModelStatus::Unfinished;
  std::vector<Label> labels;
};

/// Labels the whole network in one pass (thesis, Algorithm 3.1) over arc-consistent sets `base`,
/// cell after cell. A label that leaves some cell without any is taken back at once. A cell that
/// loses all its labels so is repaired: a region around it is taken back and labelled anew, by
/// search and then exactly, and grows until that succeeds.
///
/// With `patience`, ends Unfinished after so many large regions in a row that came to nothing.
/// Ends with Impossible where the region has grown to everything and the exact solver proves that
/// nothing fits; with Unfinished where it could not tell.
Labelling labelWhole(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, ModelStatistics& statistics,
                     const Progress& progress, std::optional<int> patience = std::nullopt);

}  // namespace exemplar
