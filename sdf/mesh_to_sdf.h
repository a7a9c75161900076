// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/axes.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Where the sign of the distance comes from.
enum class SignSource {
  Automatic,  ///< WindingNumber; RayParity for meshes without openings that cannot be oriented
  Flood,      ///< OpenVDB's flood fill from outside: for closed meshes whose orientation is not to
              ///< be trusted; hollows count as inside, signs are right beyond half a voxel
  WindingNumber,  ///< generalized winding number > 1/2 (`SolidTest`): closed, open, self-crossing
                  ///< and soup meshes; overlaps are inside, openings are closed where it is 1/2
  RayParity,      ///< majority of the parities of rays in several directions (Embree): closed soups
                  ///< whose triangles are not consistently oriented; overlaps are outside
};

/// Voxels beyond a box on each side: one number for all axes, or one for each.
struct Padding : Vec3i {
  constexpr Padding(int all = 0) : Vec3i{all, all, all} {}
  constexpr Padding(const Vec3i& each) : Vec3i(each) {}
};

struct MeshToSdfOptions {
  double voxelSize = 0;      ///< world units, > 0; 0 means: `resolution` decides
  int resolution = 64;       ///< samples along the box's longest side where voxelSize is 0; 1..4096
  std::optional<Box3d> box;  ///< what to sample; the mesh's bounding box by default
  Padding padding = 0;       ///< voxels added around the box, >= 0
  double halfWidth = 3;      ///< the distance is exact up to this many voxels, then clamped; > 0;
                             ///< infinite: exact everywhere
  SignSource sign = SignSource::Automatic;
  /// Along these axes the box is a window into something larger, and triangles that lie in its
  /// faces, or beyond and parallel to them, are where the window cut it: they bound the solid, but
  /// no distance is measured from them. `fieldToMesh` closes surfaces so. Only where `padding` is
  /// 0.
  Axes cutByBox;
};

/// The signed distance of a mesh's solid.
///
/// Samples are at voxel centers: `box` is cut into cubes of `voxelSize`, the last ones reaching
/// beyond it where its sides are no multiples (not along axes of `cutByBox`, where they end before
/// it does), and sample (0, 0, 0) is the center of the first.
/// Geometry outside the box counts.
///
/// Distances are those of the nearest triangle, exact but for rounding to float: OpenVDB's mesh to
/// volume, tried first, hands nearest triangles from voxel to voxel and is up to a voxel off beyond
/// its first ring. Which triangles count follows from the sign. With WindingNumber the field is
/// that of the outer surface alone: walls inside overlapping solids, sheets without thickness and
/// what is buried are left out, openings are capped, so that contouring at 0 finds no inner
/// surfaces; the crease where two solids cross is right to within a quarter of a voxel, a cap to
/// half a voxel. With Flood and RayParity every triangle counts. Parts thinner than a voxel come
/// out in pieces or not at all: sampling cannot hold them. Where nothing bounds a solid, all is
/// outside.
///
/// Cost on one core: about 1 microsecond a sample in the band, 0.1 elsewhere, up to 1 for each
/// sample of a mesh with openings; 20 a triangle for looking for crossings. A full field costs
/// about 1 microsecond for every sample. Memory: 5 bytes a sample, 16 for meshes with openings, and
/// 500 a triangle. The same bytes at any number of threads. Throws
/// `InputError` for a mesh that does not `validate`, options out of range and fields that would not
/// fit in memory, and `Cancelled`.
///
/// Where triangles cross very densely, creases are coarser than that (`sdf/solid_surface.h`).
DistanceField meshToSdf(const TriangleMesh& mesh, const MeshToSdfOptions& options = {},
                        const Progress& progress = {});

}  // namespace exemplar
