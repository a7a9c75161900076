// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// Which cells of a mesh are not empty.
enum class VoxelFill {
  Solid,    ///< whose centers are inside
  Surface,  ///< that hold a part of the surface
  Both,     ///< either: nothing is lost, and solids are up to half a cell thicker
};

struct MeshToLabelsOptions {
  Vec3d cellSize{0, 0, 0};   ///< world units, > 0; 0, 0, 0: cubes, of a size that follows from
                             ///< `resolution`
  int resolution = 64;       ///< cells along the box's longest side where cellSize is 0; 1..4096
  std::optional<Box3d> box;  ///< what to sample; the mesh's bounding box by default
  int air = 0;               ///< empty cells added at the sides and above, 0..1024
  VoxelFill fill = VoxelFill::Both;
};

/// A mesh as labels: one for each material that a cell shows, in the materials' order, and 0 for
/// empty; a mesh without materials has one, "solid". A cell with surface is of the material that
/// has most area in it (a face between two cells counts for the one behind it); one without, of its
/// nearest triangle's.
///
/// Inside is what `meshToSdf` finds it to be: open, self-crossing and unoriented meshes are not
/// refused, overlapping solids are one. Cost: about 1 microsecond a cell and 2 a part that the
/// planes between cells cut a triangle into. The same at any number of threads. Throws `InputError`
/// for a mesh that does not `validate`, for options out of range, and where memory would not do;
/// `Cancelled`.
LabelGrid meshToLabels(const TriangleMesh& mesh, const MeshToLabelsOptions& options = {},
                       const Progress& progress = {});

/// A grid of cells over a box: as many as it takes to cover it, and `air` more at the four sides
/// and above. Sides that are multiples of the cell's but for 1e-6 of one take no further cell.
/// Cells are empty; label 0 is there. Throws `InputError` for a size that is not positive and grids
/// longer than 32,767 cells, and `Cancelled`.
LabelGrid gridOver(const Box3d& box, const Vec3d& cellSize, int air, double slack = 1e-6,
                   const Progress& progress = {});

/// Whether the center of each of a grid's cells lies inside a mesh, as `meshToSdf` finds it.
Array3D<std::uint8_t> cellsInside(const TriangleMesh& mesh, const LabelGrid& grid,
                                  const Progress& progress = {});

}  // namespace exemplar
