// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"

namespace exemplar {

void annealPatches(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                   std::span<const LabelGrid> examples, std::vector<Label>& labels,
                   ModelStatistics& statistics, const Progress& progress = {});

}  // namespace exemplar
