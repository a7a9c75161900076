// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct MeshResultOptions {
  /// How many samples the result has along each axis, >= 1 each; else that is guessed from the
  /// mesh.
  std::optional<Vec3i> size;
};

/// Samples a result given as a mesh where the field that it was contoured from had its samples, so
/// that it can be measured beside its example.
///
/// Windows of cells distinguish a surface from the same surface half a voxel away, so the samples
/// are where a synthesis puts them: on the example's own, continued. The box begins at the low
/// corner of the example's, and what its faces cut of the mesh is a cut, not a surface. Where no
/// size is given, the box is the example's along axes where the mesh ends within that, and else
/// reaches as many samples beyond the mesh's last as the example's box beyond its own: right for
/// whole multiples of the example, up to what its border has of air; give the size of results
/// smaller than the example.
///
/// A mesh that does not begin within the example's box was not synthesized there; its own
/// bounding box is sampled then, widened to the grid of the example's samples.
///
/// A result contoured by `fieldToMesh` and sampled so has the field's solid cells but for those
/// within a tenth of a voxel of the surface or in parts that contouring drops, and figures of
/// windows, solid and surface agree to 0.02. Its distances are the mesh's own: what seams did to
/// the field's does not show in FPD and the eikonal residual, and bodies that rest on each other
/// are one.
///
/// Distances are exact as far as the example's, up to 16 voxels. Cost: that of `meshToSdf`. Throws
/// `InputError` for an example without samples, a mesh without triangles, and a mesh that reaches
/// beyond the size it is said to have.
DistanceField sampleMeshResult(const TriangleMesh& result, const DistanceField& example,
                               const MeshResultOptions& options = {},
                               const Progress& progress = {});

}  // namespace exemplar
