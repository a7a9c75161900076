// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/axes.h"
#include "core/progress.h"
#include "mesh/mesh_health.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/manifold.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct FieldToMeshOptions {
  /// Close the surface where the field's box cuts it, flat and with sharp rims; else it ends open
  /// there.
  bool close = true;
  /// The axes along which the field is periodic, its last sample beside its first: there the
  /// surface ends open at both faces of the box, and alike, so that copies placed side by side
  /// join. Where the surface runs along such a face, it has the upper face's part only.
  Axes wraps;
  /// Correct the field around jumps before contouring (`redistanceJumps`): a synthesized one jumps
  /// where two copied parts meet, and a jump misplaces the surface between two samples.
  bool redistance = true;
  /// Draw each vertex from the middle of its cell's crossings onto the field's zero, so that thin
  /// and round things keep their volume.
  bool project = true;
  /// Closed parts, and closed hollows, smaller than this many voxels are dropped unless they touch
  /// the box; 0 keeps everything.
  double smallestPiece = 8;
  /// Whether the report says how sound the surface is, which takes a tenth of the time.
  bool checkHealth = true;
};

/// What `fieldToMesh` did and how sound the result is.
struct FieldToMeshReport {
  MeshHealth health;  ///< with `checkHealth`
  ManifoldReport manifold;
  std::int64_t droppedPieces = 0;  ///< parts below `smallestPiece`
};

/// The surface φ = 0 as triangles (Lagae 2004, section 5.3), by OpenVDB's dual contouring of the
/// field's cells; every quad is cut along the diagonal that lies nearer to the surface.
///
/// The result winds anticlockwise seen from outside, has no triangle without area, every edge has
/// two triangles and every vertex one fan, whatever the field holds (white noise, touching voxels);
/// with `close` off, and where the field wraps, edges in the box's faces have one triangle.
/// Positions are exact to about a tenth of a voxel where the field is a smooth distance.
///
/// O(n) for n samples; about 6 bytes a sample beyond the field. The same bytes at any number of
/// threads. Throws `InputError` for options out of range, for samples that are not finite and for a
/// field without surface, saying what would give one; and `Cancelled`.
TriangleMesh fieldToMesh(const DistanceField& field, const FieldToMeshOptions& options = {},
                         const Progress& progress = {}, FieldToMeshReport* report = nullptr);

}  // namespace exemplar
