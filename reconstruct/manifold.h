// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

struct ManifoldOptions {
  /// How far the copies of a split vertex are drawn apart, each towards its own neighbors: a share
  /// of the way, 0..0.5. Above 0, sheets that touched in a vertex or along an edge come clear of
  /// each other, so that joining equal positions does not undo the split.
  double separation = 0;
  /// Turn edges and move vertices by a little until no triangle is without area.
  bool repairDegenerate = true;
};

/// What `makeManifold` had to do.
struct ManifoldReport {
  std::int64_t removedTriangles = 0;     ///< two equal corners, or pairs lying back to back
  std::int64_t splitVertices = 0;        ///< copies made because a vertex had several fans
  std::int64_t splitEdges = 0;           ///< edges halved because four or more triangles met there
  std::int64_t repairedTriangles = 0;    ///< triangles without area that got some
  std::int64_t degenerateTriangles = 0;  ///< triangles without area that remain
  std::int64_t boundaryEdges = 0;        ///< edges with one triangle, afterwards
};

/// Makes every edge that of at most two triangles, which run through it in opposite directions, and
/// every vertex that of one fan of triangles, by cutting: triangles stay where they are and get
/// corners of their own.
///
/// Where 2k triangles meet at an edge, those that bound the same solid wedge are paired, so that
/// solids which touch along an edge come apart (cutting after Gueziec, Taubin, Lazarus, Horn:
/// "Cutting and stitching: converting sets of polygons to manifold surfaces", IEEE TVCG 7(2), 2001,
/// doi:10.1109/2945.928166, here with the pairing by angle). A mesh whose edges all have as many
/// triangles running one way as the other comes out closed. Pairs of triangles with the same
/// corners and opposite winding enclose nothing and are removed. Attributes are kept.
///
/// O(n log n) for n triangles; the same bytes at any number of threads. Throws `Cancelled`; the
/// mesh is then in an intermediate state.
ManifoldReport makeManifold(TriangleMesh& mesh, const ManifoldOptions& options = {},
                            const Progress& progress = {});

}  // namespace exemplar
