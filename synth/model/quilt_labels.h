// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"

namespace exemplar {

/// Whether a result is large enough, and asks for what a smaller one shows too: no symmetry, no
/// frames, no maps of weights.
bool canQuilt(const ModelOptions& options);

/// The request for a result whose windows make up one that `options` asks for: with the same rules
/// and sides, 96 columns a side at most, and without what is said of single cells or of all
/// together.
ModelOptions quiltSampleOptions(const ModelOptions& options);

/// Covers a consistent labeling with windows of a smaller result of the same rules (Efros, Freeman:
/// "Image quilting for texture synthesis and transfer", SIGGRAPH 2001), about `pitch` columns, >=
/// 2, a side; of some random places the one that agrees best with the windows beside it; along
/// sides with a rule, from that side of `sample`. Each is put in as a `PatchMove`: what crosses its
/// border comes or goes as a whole, and gaps are closed by search, so that `labels` is consistent
/// afterwards; where that does not succeed smaller windows are tried, and then what was there
/// stays.
///
/// What the example holds is then decided for `sample` alone, at a hundredth of the cost of
/// annealing a large result; joints are left to `annealPatches`. Windows that are far apart are
/// laid at the same time: the same bytes at any number of threads. O(cells). Returns the share of
/// columns that windows cover. Throws `Cancelled`.
double quiltLabels(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                   const LabelGrid& sample, int pitch, std::vector<Label>& labels,
                   const Progress& progress = {});

}  // namespace exemplar
