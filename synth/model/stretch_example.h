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

/// A consistent labeling to begin with where things run over the sides and no patch could begin
/// them: an example drawn out to the result's size. Along each axis its planes come in an order in
/// which every two that follow each other may be neighbors cell by cell: mostly as in the example,
/// with planes that suit repeated, or gone back to; at random, the seldom used ones rather. At a
/// side with a rule a plane comes that the rule allows.
///
/// None where no such order is as long as the result, where pins, holes or a symmetry do not suit,
/// or neighbors are further than one cell apart. O(planes^2 x cells of a plane + planes x length)
/// for each axis, and O(cells).
std::optional<std::vector<Label>> stretchExample(const ModelProblem& problem, const LabelSets& base,
                                                 const LabelChooser& chooser,
                                                 std::span<const LabelGrid> examples,
                                                 const Progress& progress = {});

}  // namespace exemplar
