// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A mesh of at most `triangles` triangles (>= 1) that looks like `mesh`, whatever it is, for
/// pictures only: vertices in one cell of a grid become one at their mean, triangles that lose a
/// corner so are gone (J. Rossignac, P. Borrel, "Multi-resolution 3D approximations for rendering
/// complex scenes", 1993). The finest grid that does it is taken, of 4096 cells along the longest
/// side at most. Attributes are lost. O(n log n) for n triangles; deterministic.
TriangleMesh simplifySoup(const TriangleMesh& mesh, std::int64_t triangles);

}  // namespace exemplar
