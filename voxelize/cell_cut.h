// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/huge_pages.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A corner of a triangle's part within a cell.
struct CutPoint {
  Vec3d p;        ///< in cells from the grid's corner
  Vec3d weights;  ///< of the triangle's three corners; they sum to 1
};

/// The part of a triangle within one cell: a convex polygon that winds as the triangle does.
struct CutPolygon {
  std::uint32_t triangle = 0;
  std::uint32_t first = 0, count = 0;  ///< its points in `CellCut::points`
};

/// A mesh cut along the planes between the cells of a grid. A face within such a plane belongs to
/// the cell behind it, which is the solid one where the mesh bounds a solid.
struct CellCut {
  Vec3i size;
  std::vector<CutPoint> points;
  std::vector<CutPolygon> polygons;  ///< cell by cell (x fastest), in each by triangle
  HugeVector<std::uint32_t> first;  ///< the first polygon of each cell, and their number at the end
};

/// Points nearer to a plane between cells than this are moved onto it, in cells.
inline constexpr double kCutTolerance = 1e-6;

/// Cuts a mesh along a grid of `size` cells of `cellSize` from `origin`; what lies outside the grid
/// is left out, but for faces in its sides. Points nearer than `tolerance` cells to a plane between
/// cells are moved onto it. Triangles that share an edge share the points along it, to the bit.
/// O(parts); the same at any number of threads. Throws `InputError` where the parts would not fit
/// in memory, and `Cancelled`.
CellCut cutAlongCells(const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& cellSize,
                      const Vec3i& size, double tolerance = kCutTolerance,
                      const Progress& progress = {});

/// Twice the area of a cut polygon times its unit normal, in cells.
Vec3d areaNormal(const CellCut& cut, const CutPolygon& polygon);

}  // namespace exemplar
