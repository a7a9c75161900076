// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/array3d.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

// Distances in index space, where sample ijk stands at (i, j, k), by OpenVDB's mesh to volume: it
// scan-converts the triangles and grows the band voxel by voxel from the nearest triangles of the
// neighbours.

/// Lowers each of `distances` to the sample's distance from the nearest triangle where that is less
/// than `halfWidth` voxels. Time and memory go with the triangles' area, also outside the samples:
/// clip first.
void lowerToDistance(std::span<const Corners> triangles, double halfWidth,
                     Array3D<float>& distances);

/// 1 at the samples that a flood from outside does not reach, else 0. The surface should be closed;
/// how it is oriented does not matter.
Array3D<std::uint8_t> floodedInside(std::span<const Corners> triangles, const Vec3i& size);

}  // namespace exemplar
