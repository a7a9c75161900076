// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "mesh/triangle_mesh.h"

namespace exemplar::continuous {

/// Makes a closed surface that touches itself in points and edges manifold: vertices there are
/// copied, one for each of what meets there. Where more than two triangles share an edge, those
/// with a solid between them stay together. The surface stays closed and where it was; copies are
/// behind the vertices that were there. Returns how many were made. Edges at which triangles do
/// not alternate around (the surface is not closed, or overlaps itself) stay as they are.
std::size_t separateTouching(TriangleMesh& mesh);

}  // namespace exemplar::continuous
