// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "voxelize/label_grid.h"
#include "voxelize/model_pieces.h"

/// Grids of labels as engines of games place them (docs/hosts.md).
namespace exemplar {

/// A grid as JSON: `size`, `cell_size` and `origin` in world units, z up; `cells`, an index into
/// `pieces` for each cell, x fastest, then y, then z, -1 where nothing is placed; and `pieces`, for
/// each its `name`, the quarter `turns` and the `mirror` that make it of the mesh of that name in
/// the library of pieces. Without `pieces` (labels that no mesh was cut into) each has the label's
/// `name` and `color` in their place.
std::string placedCellsJson(const LabelGrid& grid, const ModelPieces* pieces);

/// A grid of pieces as a table, a line for each cell with a mesh: x,y,z,piece,turns,mirror.
std::string placedCellsCsv(const LabelGrid& grid, const ModelPieces& pieces);

}  // namespace exemplar
