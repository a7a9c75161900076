// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Which normals a mesh file gets.
enum class MeshNormals {
  Crease,  ///< smooth, with hard edges where faces meet at more than 40 degrees
  Smooth,  ///< one for all faces that meet around a vertex
  None,    ///< none; most viewers then show facets
};

/// Unit normals, and which of them each corner of each triangle has.
struct ShadingNormals {
  std::vector<Vec3f> normals;
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< m triangles: indices into normals
};

/// The normals of corners: the mean of the facets' normals, weighted by their angles at the vertex
/// (G. Thuermer and C. A. Wuethrich, "Computing vertex normals from polygonal facets", Journal of
/// Graphics Tools 3(1), 1998, doi:10.1080/10867651.1998.10487487), over the facets that lead from
/// one to the next around the vertex across smooth edges. Corners of one such fan share a normal.
///
/// Edges are smooth where two triangles of one winding meet there at no more than 40 degrees (any
/// angle below 155 degrees for Smooth). Open edges of equal position count as one, so that a soup
/// is smooth, too. Triangles without area take a normal that their vertex has. For None, empty.
/// O(n log n), in parallel; the same at any number of threads. Throws `Cancelled`.
ShadingNormals shadingNormals(const TriangleMesh& mesh, MeshNormals normals,
                              const Progress& progress = {});

/// The same with hard edges where faces meet at more than `creaseAngle` (radians, 0..pi).
ShadingNormals shadingNormals(const TriangleMesh& mesh, double creaseAngle,
                              const Progress& progress = {});

/// For each position the index of the first one that is equal to it. Throws `Cancelled`.
std::vector<std::uint32_t> firstOfEqual(const std::vector<Vec3d>& positions,
                                        const Progress& progress = {});

}  // namespace exemplar
