// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "synth/model/problem.h"

namespace exemplar {

/// Takes from `base`, the labels that a request leaves each cell, what has no support around it
/// (thesis, statement 3.6), until nothing more goes; false where a cell loses all of its labels.
/// What remains does not depend on the order of work, so the order is one that is soon done: pieces
/// of the network by themselves, in parallel; then all cells, to and fro, each `column` of cells
/// that follow each other until nothing goes in it, since what a side rules out may reach far into
/// a result, further at every height, and would otherwise change each cell once for each. The same
/// sets at any number of threads. Throws `Cancelled`.
bool makeArcConsistent(const LabelNetwork& network, LabelSets& base, int column,
                       const Progress& progress = {});

/// Narrows `base` to sets that are consistent, too, and alike in all columns further than 48 from
/// every side: enough to label a large result from, and found in O(cells), however far sides reach.
/// Labels that only a larger middle could have are missing, so that what these sets leave out is
/// not proved impossible. False, and `base` as it was, where there are none.
bool makeConsistentByTile(const ModelProblem& problem, LabelSets& base,
                          const Progress& progress = {});

}  // namespace exemplar
