// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"

namespace exemplar {

/// A consistent labeling to begin with where things run over the sides: the example again and again
/// along x and y, one to four cells apart. What lies between is found by search and by the exact
/// solver, so that all that runs over one side goes on to the opposite one. Labels that nothing can
/// go on from give way, those in the middle last; where that does not do, up to three of the
/// example's outermost columns, and at last all that must. Where the result is higher than the
/// example, what is above is free.
///
/// None where none of this is found soon, where the result is not larger than the example, for
/// examples of more than some 8,000 cells, and for pins, holes, frames or a symmetry. O(cells of
/// the example^2) for each gap, and O(cells).
std::optional<std::vector<Label>> repeatExample(const ModelProblem& problem, const LabelSets& base,
                                                const LabelChooser& chooser,
                                                const LabelGrid& example,
                                                ModelStatistics& statistics,
                                                const Progress& progress = {});

}  // namespace exemplar
