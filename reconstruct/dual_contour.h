// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/contour_field.h"

namespace exemplar {

/// The surface of a contour field as triangles, in index space: OpenVDB's dual contouring, which
/// puts one vertex into each cell that the surface crosses (two where it crosses twice). Vertices
/// of cells in the box's faces are put onto the faces, and quads are cut along the diagonal that
/// lies nearer to the surface. `onZero`: each vertex is moved from the middle of its cell's
/// crossings onto the field's zero. The result need not be manifold. Throws `Cancelled`.
TriangleMesh dualContour(const ContourField& field, bool onZero, const Progress& progress = {});

}  // namespace exemplar
