// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"
#include "synth/model/whole.h"

namespace exemplar {

/// Modifies a consistent labeling in blocks that overlap by half along all axes (thesis, Algorithm
/// 3.4). Each block is a `Region`: taken back and relabeled, by plain propagation first, then by
/// search with backjumping. A block for which these fail stays as it was, so the labeling is
/// consistent throughout, and the time is linear in the cells.
///
/// With `sparse` only two of the eight families of blocks are modified, those half a block apart
/// along all axes: each cell twice, in a third to a quarter of the time.
///
/// Blocks that do not touch are modified in parallel; each sees exactly the blocks that come before
/// it in a fixed order, so the bytes are the same at any number of threads. Throws `Cancelled`.
Labeling labelInBlocks(const ModelProblem& problem, const LabelSets& base,
                       const LabelChooser& chooser, std::vector<Label> start, bool sparse,
                       ModelStatistics& statistics, const Progress& progress);

}  // namespace exemplar
