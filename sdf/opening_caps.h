// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/solid_test.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// The surface of the solid where no triangle is: the caps of a soup's openings, on which the
/// winding number is 1/2. Samples are at low + ijk; `inside` says which are in the solid,
/// `distances` how far each is from the bounding triangles (exact up to 2 voxels).
///
/// Crossings of the grid's edges are found to within a hundredth of a voxel, or a sixteenth where
/// `fine` is false, in half the time, and joined into a
/// surface with a vertex a cell, at their mean (surface nets: Gibson, "Constrained elastic surface
/// nets", MICCAI 1998, section 2, without relaxation). Where a cap meets triangles it reaches into
/// their cells. Throws `Cancelled`.
std::vector<Corners> openingCaps(const SolidTest& solid, const Vec3i& low,
                                 const Array3D<std::uint8_t>& inside,
                                 const Array3D<float>& distances, bool fine = true,
                                 const Progress& progress = {});

}  // namespace exemplar
