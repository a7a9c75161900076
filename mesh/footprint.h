// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "core/turn.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// How a mesh lies, seen from above.
struct Footprint {
  double angle = 0;      ///< of its own axes against x and y: anticlockwise, -pi/4 < angle <= pi/4
  double along = 0;      ///< its extent along the axis that is nearer to x, world units
  double across = 0;     ///< and across that
  bool straight = true;  ///< it fills its box as it lies, or has no axes of its own
};

/// Finds how a mesh is turned about the vertical.
///
/// Its axes are those that most of its steep faces stand across: three fifths of their area within
/// two degrees. Meshes without such faces, as rough walls are, have those of the rectangle of least
/// area around their points (its sides lie along the convex hull's: Freeman and Shapira,
/// "Determining the minimum-area encasing rectangle for an arbitrary closed curve", CACM 1975).
/// Faces count as turned from a degree on, rectangles from three degrees on and only where the mesh
/// fills less than four fifths of its box that way: round things are straight. O(n log n). Throws
/// `Cancelled`.
Footprint footprintOf(const TriangleMesh& mesh, const Progress& progress = {});

/// Turns a mesh.
void turn(TriangleMesh& mesh, const Turn& by);

}  // namespace exemplar
