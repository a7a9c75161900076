// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// How fine the detail of a mesh's solid is, world units: what 3 % of its surface is below;
/// infinite where less than that has anything opposite.
struct DetailSize {
  double thickness;  ///< through the solid, to where the surface faces the other way
  double gap;        ///< through the air, to where another part of the surface faces it
};

/// Measures the solid that `meshToSdf` samples: from 4,096 points spread evenly over its surface,
/// rays go straight in and straight out (Embree). Surfaces count as opposite within 18 degrees of
/// parallel, so that wedges, edges and the contacts of round things, which are infinitely fine at
/// any resolution, are not detail. O(n log n) for n triangles and about 20 ms for the rays.
/// Deterministic. Throws `Cancelled`.
DetailSize detailSize(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace exemplar
