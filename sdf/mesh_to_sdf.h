// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Where the sign of the distance comes from.
enum class SignSource {
  Automatic,  ///< Flood for closed, manifold, oriented meshes without self-crossings; else Winding
  Flood,      ///< OpenVDB's flood fill from outside: for closed meshes
  WindingNumber,  ///< generalized winding number > 1/2: open, self-crossing and soup meshes
  RayParity,      ///< majority of the parities of rays in several directions (Embree): closed soups
                  ///< whose triangles are not consistently oriented
};

struct MeshToSdfOptions {
  double voxelSize = 0;      ///< world units, > 0; 0 means: `resolution` decides
  int resolution = 64;       ///< samples along the box's longest side where voxelSize is 0; 1..4096
  std::optional<Box3d> box;  ///< what to sample; the mesh's bounding box by default
  int padding = 0;           ///< voxels added around the box on each side, >= 0
  double halfWidth = 3;      ///< the distance is exact up to this many voxels, then clamped; > 0;
                             ///< infinite: exact everywhere
  SignSource sign = SignSource::Automatic;
};

/// The signed distance of a mesh, by OpenVDB's mesh to volume, with the sign from `options.sign`.
///
/// Samples stand at voxel centres: `box` is cut into cubes of `voxelSize`, the last ones reaching
/// beyond it where its sides are no multiples, and sample (0, 0, 0) is the centre of the first.
/// Geometry outside the box counts. Within half a voxel of the analytic distance on smooth shapes.
/// The same bytes at any number of threads. Throws `InputError` for options out of range and fields
/// that would not fit in memory.
DistanceField meshToSdf(const TriangleMesh& mesh, const MeshToSdfOptions& options = {},
                        const Progress& progress = {});

}  // namespace exemplar
