// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/closest_point.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// How a line along x through (y, z) crosses a triangle: 1 out of its front, -1 into it, 0 not.
///
/// Exact for any doubles, and as if (y, z) were moved by (e, e^2) for an infinitely small e > 0
/// (Edelsbrunner, Mücke: "Simulation of simplicity", ACM Transactions on Graphics 9(1), 1990): of
/// triangles that meet at an edge or a corner a line through it crosses as many as one beside it.
/// So the crossings of a closed surface along a line add up to 0, and those beyond a point to its
/// winding number.
int crossesRow(const Corners& triangle, double y, double z);

/// The winding number of closed triangles around `p`: what crosses the line from there towards +x.
/// Much faster than `TriangleTree::windingNumber`; wrong for open ones. O(log n) for n triangles,
/// and as many more as the line crosses.
int windingAlongRow(const TriangleTree& tree, const Vec3d& p);

/// Sets `inside` to 1 where closed triangles wind around the point low + ijk, either way, and
/// leaves it elsewhere. O(samples + the rows that each triangle meets). Throws `Cancelled`.
void markInside(const TriangleTree& tree, const Vec3i& low, Array3D<std::uint8_t>& inside,
                const Progress& progress = {});

}  // namespace exemplar
