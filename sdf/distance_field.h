// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/array3d.h"
#include "core/vec.h"

namespace exemplar {

/// A signed distance field, sampled densely: negative inside, world units.
///
/// A field made by `meshToSdf` holds the exact distance to the surface, clamped to ±`truncation`. A
/// synthesized field is right in sign and nearly a distance within each copied part; `redistance`
/// makes it one again.
struct DistanceField {
  Array3D<float> values;
  double voxelSize = 1;  ///< distance of neighboring samples, world units
  Vec3d origin{};        ///< world position of sample (0, 0, 0)
  float truncation = 0;  ///< |values| <= truncation, world units; infinite for a full field

  const Vec3i& size() const { return values.size(); }
  /// The world position of an index, which may be fractional or outside.
  Vec3d position(const Vec3d& ijk) const { return origin + ijk * voxelSize; }
  /// The index, fractional, of a world position.
  Vec3d index(const Vec3d& xyz) const { return (xyz - origin) / voxelSize; }
  /// The field's box: half a voxel beyond the outer samples on each side.
  Box3d box() const {
    const Vec3d half{voxelSize / 2, voxelSize / 2, voxelSize / 2};
    return {origin - half, origin + cast<double>(size()) * voxelSize - half};
  }
};

}  // namespace exemplar
