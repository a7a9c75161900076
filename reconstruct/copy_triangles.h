// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/origin.h"
#include "core/progress.h"
#include "mesh/mesh_health.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/transfer.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct CopyTrianglesOptions {
  /// Rims of neighboring parts that are this near to each other are joined, voxels, 0..1.
  double weld = 0.5;
  /// Smoothing steps at the seams (see `smooth`), 0..10000.
  int relax = 10;
};

/// What `copyTriangles` made.
struct CopiedTriangles {
  TriangleMesh mesh;
  MeshHealth health;
  std::int64_t motions = 0;         ///< different ways in which parts were copied
  std::int64_t wholeTriangles = 0;  ///< copied in one piece
  std::int64_t cutTriangles = 0;    ///< copied in part, because the copied part ends there
};

/// The paper's own reconstruction (Lagae 2004, section 5.3): "When a block is copied from the
/// source to the target, we output the corresponding geometry, and afterward, we smooth the output
/// geometry using mesh relaxation."
///
/// Every example triangle is copied to wherever the origins say that its cells went, cut at the
/// borders of the copied part, with its material, colors and texture coordinates. Rims of
/// neighboring parts are joined where they nearly meet, and the seams relaxed.
///
/// This keeps the example's triangles exactly, and its sharp edges; but copied parts rarely fit, so
/// the result is open along seams and at the box, which `health` reports. `fieldToMesh` gives
/// closed surfaces. Differences from the paper: triangles are cut instead of taken whole, because a
/// large one may cross many blocks, and only seams are smoothed, by a filter that does not shrink.
///
/// O(p log p) for p pairs of a surface cell and a triangle in it. The same bytes at any number of
/// threads. Throws `InputError` for options out of range, where origins and field do not match or
/// name an example that is not given, and where no triangle was copied; and `Cancelled`.
CopiedTriangles copyTriangles(const DistanceField& field, const Origins& origins,
                              std::span<const ExampleView> examples,
                              const CopyTrianglesOptions& options = {},
                              const Progress& progress = {});

/// The same for one example.
CopiedTriangles copyTriangles(const DistanceField& field, const Origins& origins,
                              const TriangleMesh& example, const DistanceField& exampleField,
                              const CopyTrianglesOptions& options = {},
                              const Progress& progress = {});

}  // namespace exemplar
