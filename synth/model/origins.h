// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/origin.h"
#include "core/progress.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// For each cell of a grid a cell of the examples with the same label: where the six neighbors
/// agree too, if there is such a place, else where most of them do. Among these the one that goes
/// on from an earlier neighbor's origin is taken, so that whole parts come from one place; else the
/// first. O(cells), and O(cells of the examples) for a new surrounding. Deterministic.
///
/// Throws `InputError` for a label that no example has, an example longer than 32,767 cells or more
/// than 255 examples: origins do not hold these.
Origins findOrigins(const LabelGrid& grid, std::span<const LabelGrid> examples,
                    const Progress& progress = {});

}  // namespace exemplar
