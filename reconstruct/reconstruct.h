// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "mesh/mesh_health.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/transfer.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// One of the examples of a synthesis. What is borrowed outlives the call.
struct ReconstructExample {
  const DistanceField& field;
  const TriangleMesh* mesh = nullptr;  ///< none: nothing to take materials and colors from
};

struct ReconstructOptions {
  FieldToMeshOptions contour;
  /// Merge triangles of the contour where the surface stays within this many voxels of where it was
  /// (`decimate`), >= 0; 0 for not at all. Not where the field wraps: copies would not join.
  double simplify = 0;
  /// Stop merging at this many triangles, >= 0; with `simplify` 0, merge until there are no more.
  std::int64_t triangles = 0;
  /// How many coarser copies are made, 0..8, each with a quarter of the triangles of the one
  /// before as far as its shape allows. Not where the field wraps.
  int lods = 0;
  TransferOptions appearance;
};

/// A surface with fewer triangles.
struct CoarserSurface {
  TriangleMesh mesh;
  MeshHealth health;
};

struct Reconstruction {
  TriangleMesh mesh;
  MeshHealth health;
  std::vector<CoarserSurface> lods;  ///< the same surface coarser and coarser
  std::int64_t contoured = 0;        ///< triangles before they were merged
  FieldToMeshReport contour;         ///< without its health
};

/// From what a synthesis returns to what leaves the program: contours the field, and takes
/// materials, colors and textures from the examples where all of them have triangles. The result is
/// closed (unless `contour.close` is off or the field wraps), manifold and oriented; `health` says
/// so. The same bytes at any number of threads. Throws `InputError` as the steps do, and
/// `Cancelled`.
Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  std::span<const ReconstructExample> examples,
                                  const ReconstructOptions& options = {},
                                  const Progress& progress = {});

/// The same for one example.
Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  const ReconstructExample& example,
                                  const ReconstructOptions& options = {},
                                  const Progress& progress = {});

}  // namespace exemplar
