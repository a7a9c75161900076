// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"

namespace exemplar {

/// A consistent labeling for patches to go on from where things run over the sides, and no patch
/// could begin or end them: of the example drawn out (`stretchExample`), the example again and
/// again (`repeatExample`), the most frequent labels, and labels at random, with sides as the
/// example's where they are open; of those that are found soon, the one that is nearest to the
/// example's statistics after a twentieth of the request's moves each. None where none is found.
/// Throws `Cancelled`.
std::optional<std::vector<Label>> startOverSides(const ModelProblem& problem, const LabelSets& base,
                                                 const LabelChooser& chooser,
                                                 std::span<const LabelGrid> examples,
                                                 ModelStatistics& statistics,
                                                 const Progress& progress = {});

}  // namespace exemplar
