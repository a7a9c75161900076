// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/progress.h"
#include "sdf/solid_test.h"
#include "sdf/triangle_soup.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// What bounds a solid.
struct BoundingSurface {
  std::vector<Corners> triangles;
  /// Pieces along crossings are no longer than 0.4 voxels: the surface is right to within a quarter
  /// of a voxel. Else they are longer, and where the sign changes has to be looked at beside them.
  bool fine = true;
};

/// The part of the triangles that has the solid on one side only: what lies buried where solids
/// overlap, or is a sheet without thickness, is left out. Triangles that cross others are cut
/// into pieces of 0.4 voxels along the crossing, so that the part's border is right to within a
/// quarter of a voxel; far from the samples the pieces are larger. Where triangles cross so
/// densely that this would make more pieces than 4 n and a quarter of the samples, all pieces
/// are longer.
///
/// Index space: samples are at whole numbers from (0, 0, 0) to `size`. Triangles farther than
/// `reach` voxels from the samples are left out. O(n log n + k) for n triangles of bounded size and
/// k pairs that meet: about 10 microseconds a triangle that crosses others or is part of an open
/// soup, less for closed ones, where one answer holds for all triangles up to the next crossing.
/// The same triangles in the same order at any number of threads. `tree` holds the soup's triangles
/// in their order. Throws `Cancelled`.
BoundingSurface boundingTriangles(const TriangleSoup& soup, const TriangleTree& tree,
                                  const SolidTest& solid, const Vec3i& size, double reach,
                                  const Progress& progress = {});

}  // namespace exemplar
