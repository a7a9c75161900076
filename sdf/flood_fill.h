// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// 1 at the samples that a flood from outside does not reach, else 0, by OpenVDB's mesh to volume;
/// sample ijk is at (i, j, k). The surface should be closed; how it is oriented does not
/// matter. Hollows count as inside, and walls thinner than a voxel may leak.
///
/// Time and memory go with the triangles' area in voxels, also outside the samples. Throws
/// `InputError` where that would not fit in memory, and `Cancelled`.
Array3D<std::uint8_t> floodedInside(std::span<const Corners> triangles, const Vec3i& size,
                                    const Progress& progress = {});

}  // namespace exemplar
