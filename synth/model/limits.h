// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"
#include "synth/model/whole.h"

namespace exemplar {

/// How far a labeling is from a request's limits on counts and from connectedness: labels too many
/// or too few, and cells outside the largest piece of each connected set. 0: all are met.
std::int64_t limitsMissed(const ModelProblem& problem, const std::vector<Label>& labels);

/// The first limit on counts that the sets `base` show cannot be met, whatever the labels are: one
/// that asks for more of its labels than cells may have one of them, or for fewer than cells must;
/// counts of which no two share a label and that ask for more cells than there are count as one.
/// A sentence that says why, or nothing.
std::optional<std::string> impossibleLimit(const ModelProblem& problem, const LabelSets& base);

/// Changes a consistent labeling until limits on counts and connectedness are met: a `Region` where
/// one is broken is relabeled, with the labels in question left out or put in, and kept unless
/// the limits are then missed by more. Unfinished after `ModelOptions::budget` tries, or two
/// thousand without a gain. Each labeling on the way is consistent. Throws `Cancelled`.
Labeling meetLimits(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                    std::vector<Label> labels, ModelStatistics& statistics,
                    const Progress& progress);

}  // namespace exemplar
