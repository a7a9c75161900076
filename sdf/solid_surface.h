// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/progress.h"
#include "sdf/solid_test.h"
#include "sdf/triangle_soup.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// The part of the triangles that has the solid on one side only: what lies buried where solids
/// overlap, or is a sheet without thickness, is left out. Triangles that cross others are cut
/// into pieces of 0.4 voxels along the crossing, so that the part's border is right to within a
/// quarter of a voxel; far from the samples the pieces are larger.
///
/// Index space: samples are at whole numbers from (0, 0, 0) to `size`. Triangles farther than
/// `reach` voxels from the samples are left out. About 10 microseconds a triangle for open soups,
/// less for closed ones, where one answer holds for all triangles up to the next crossing. The same
/// triangles in the same order at any number of threads. `tree` holds the soup's triangles in their
/// order. Throws `Cancelled`.
std::vector<Corners> boundingTriangles(const TriangleSoup& soup, const TriangleTree& tree,
                                       const SolidTest& solid, const Vec3i& size, double reach,
                                       const Progress& progress = {});

}  // namespace exemplar
