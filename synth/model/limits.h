// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"
#include "synth/model/whole.h"

namespace exemplar {

/// How far a labelling is from a request's limits on counts and from connectedness: labels too many
/// or too few, and cells outside the largest piece of each connected set. 0: all are met.
std::int64_t limitsMissed(const ModelProblem& problem, const std::vector<Label>& labels);

/// Changes a consistent labelling until limits on counts and connectedness are met: a region where
/// one is broken is labelled anew, with the labels in question left out or put in, and kept where
/// that brings the labelling nearer. Unfinished after `ModelOptions::budget` tries, or two thousand
/// without a gain. Each labelling on the way is consistent.
Labelling meetLimits(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, std::vector<Label> labels,
                     ModelStatistics& statistics, const Progress& progress);

}  // namespace exemplar
