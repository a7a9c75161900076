// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "voxelize/label_grid.h"

namespace exemplar {

struct LabelMeshOptions {
  /// Whether each label gets its own closed surface. Otherwise faces between two cells that
  /// are not empty are left out: the outside alone, as much as a picture shows, for opaque labels.
  bool closedLabels = true;
};

/// The cells of a grid that are not empty as boxes, in the colors of their labels: one material
/// for each label that is there, named after it or "label N".
///
/// Neighboring faces of one label in one plane are merged to rectangles, and rectangles that meet
/// share every vertex along their rims, so that no cracks are left. The surface of each label is
/// then closed and faces outwards, edge for edge; cells of a label that touch along an edge or at a
/// corner alone have vertices of their own there, so that it is manifold, too, but for edges whose
/// both ends are joined through further cells. An empty mesh where every cell is empty. O(cells);
/// the same at any number of threads.
TriangleMesh labelMesh(const LabelGrid& grid, const LabelMeshOptions& options = {},
                       const Progress& progress = {});

}  // namespace exemplar
