// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A unit normal for each corner of each triangle (m): the mean of the normals of the triangles
/// around the vertex that meet this one at less than `creaseAngle` (radians), weighted by their
/// angles at the vertex (G. Thuermer and C. A. Wuethrich, "Computing vertex normals from polygonal
/// facets", Journal of Graphics Tools 3(1), 1998, doi:10.1080/10867651.1998.10487487).
///
/// Different from there: vertices of equal position count as one, so that a soup is smooth too, and
/// a neighbor that is wound the other way counts with its normal turned round. Corners of triangles
/// without area are zero. Where more than 512 triangles meet, corners keep their own facet's
/// normal. O(m) for bounded valence; the same at any number of threads.
std::vector<std::array<Vec3f, 3>> cornerNormals(const TriangleMesh& mesh, double creaseAngle);

}  // namespace exemplar
