// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/axes.h"
#include "core/progress.h"
#include "sdf/distance_field.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

struct RedistanceOptions {
  double halfWidth = 3;  ///< exact up to this many voxels, then clamped; > 0; infinite: everywhere
};

/// A field that is right in sign, turned into a true distance again: to its own zero set, linear
/// between samples. Signs stay as they are, so no zero crossing leaves the edge of the grid that it
/// is on;
/// along that edge it moves by a small fraction of a voxel, and not at all where the surface is
/// flat.
///
/// The zero set is cut from the six tetrahedra of each cell, which leave no ambiguous cases, and
/// distances to it are exact, so there is no sweep that could stop early. About 1 microsecond a
/// sample in the band. Where the field has no crossing, every sample is at ±truncation (for an
/// infinite `halfWidth`: at the length of the box's diagonal). The surface ends at the box's sides.
/// The same bytes at any number of threads. Throws `InputError` for options out of range, and
/// `Cancelled`.
DistanceField redistance(const DistanceField& field, const RedistanceOptions& options = {},
                         const Progress& progress = {});

/// The field with its distances corrected around jumps only: near the surface, where neighboring
/// samples differ by more than their distance allows, as where copied parts meet. Elsewhere it
/// stays as it is, for a distance measured to the samples' own zero set is less exact than one
/// measured to the example. `wraps`: the axes along which the field is periodic.
///
/// O(n) for n samples, and some microseconds for each sample that changes; 3 bytes a sample beyond
/// the result. The same bytes at any number of threads. Throws `Cancelled`.
DistanceField redistanceJumps(const DistanceField& field, const Axes& wraps = {},
                              const Progress& progress = {});

/// The zero set of samples as triangles, positions in index space, wound anticlockwise seen from
/// the positive side: closed but for the box's sides. Degenerate where samples are exactly 0. With
/// `where` (of the samples' size) only that of cells with a corner whose mark is not 0. Throws
/// `Cancelled`.
std::vector<Corners> zeroSet(const Array3D<float>& values,
                             const Array3D<std::uint8_t>* where = nullptr,
                             const Progress& progress = {});

}  // namespace exemplar
