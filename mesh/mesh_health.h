// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// What is sound and unsound about a mesh (measures: "mesh health"). Edges are pairs of vertex
/// indices: a mesh whose equal positions are not joined counts as open. Triangles with two equal
/// corner indices are counted as degenerate and have no part in the edges.
struct MeshHealth {
  std::int64_t vertices = 0, triangles = 0;
  std::int64_t boundaryEdges = 0;        ///< edges with one triangle
  std::int64_t nonManifoldEdges = 0;     ///< edges with three or more triangles
  std::int64_t nonManifoldVertices = 0;  ///< vertices whose triangles form more than one fan
  std::int64_t misorientedEdges = 0;     ///< edges that two triangles run through the same way
  std::int64_t degenerateTriangles = 0;  ///< two equal corners, or zero area
  /// Crossing pairs of triangles that share no vertex, where the options ask for it. Triangles that
  /// only touch, or that lie in one plane, do not cross.
  std::int64_t selfIntersections = 0;
  std::int64_t components = 0;  ///< connected by shared vertices
  double signedVolume = 0;      ///< world units cubed; negative where turned inside out

  bool closed() const { return boundaryEdges == 0; }
  bool manifold() const { return nonManifoldEdges == 0 && nonManifoldVertices == 0; }
  bool oriented() const { return misorientedEdges == 0; }
};

struct MeshHealthOptions {
  bool selfIntersections = false;  ///< count them too; several times as slow as the rest
};

/// O(n log n) for n triangles; the same at any number of threads. Throws `Cancelled`.
MeshHealth meshHealth(const TriangleMesh& mesh, const MeshHealthOptions& options = {},
                      const Progress& progress = {});
MeshHealth meshHealth(const TriangleMesh& mesh, const Progress& progress);

}  // namespace exemplar
