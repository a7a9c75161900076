// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/progress.h"
#include "synth/model/problem.h"

namespace exemplar {

/// Why an impossible request is impossible: a set of pins and side rules that exclude each other
/// and of which none can be left out, and a sentence that says so. Whether a set is still
/// impossible is decided by propagation where that suffices, and by the exact solver within the
/// request's budget where it does not; a demand that it could not decide about stays in the set.
///
/// `looks` names the labels. About O(pins) propagations of the whole network.
ModelConflict explainConflict(const ModelProblem& problem, std::span<const LabelLook> looks,
                              const Progress& progress = {});

}  // namespace exemplar
