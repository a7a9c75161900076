// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Joins vertices whose positions agree to within `tolerance` (world units, > 0) along each axis,
/// and drops the triangles that lose a corner by it. Colors of joined vertices are averaged.
/// `part`, one number a vertex, follows the vertices; the lowest of those joined stays.
/// Both throw `Cancelled`.
void weldVertices(TriangleMesh& mesh, double tolerance, std::vector<std::uint32_t>& part,
                  const Progress& progress = {});

/// Closes narrow gaps between parts: rim vertices of different parts that are each other's nearest
/// within `tolerance` meet halfway, and rim edges take up the rim vertices that lie on them to
/// within `tolerance` (of another part) or a thousandth of it (of their own). Rims farther apart
/// stay open.
void stitchRims(TriangleMesh& mesh, double tolerance, std::vector<std::uint32_t>& part,
                const Progress& progress = {});

}  // namespace exemplar
